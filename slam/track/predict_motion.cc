#include "slam/track/predict_motion.h"

namespace aisle::slam {

std::optional<MeasuredMotion> PredictMotion(const TrackMemory& memory, std::int64_t stamp_ns,
                                            const TrackOptions& options) {
  const double gap_s = static_cast<double>(stamp_ns - memory.stamp_ns) * 1e-9;
  if (!memory.velocity || gap_s <= 0 || gap_s > options.longest_gap_s) return std::nullopt;
  return Carry(*memory.velocity, gap_s, options.inertia);
}

Eigen::Isometry3d ReckonedPose(const Map& map, const TrackMemory& memory, std::int64_t stamp_ns,
                               const TrackOptions& options) {
  if (map.empty()) return Eigen::Isometry3d::Identity();
  const double gap_s = static_cast<double>(stamp_ns - memory.stamp_ns) * 1e-9;
  return PredictPose(map.PoseOf(memory.reference) * memory.T_reference_rig, memory.motion,
                     std::min(gap_s, options.longest_gap_s));
}

}  // namespace aisle::slam
