#include "slam/track/predict_motion.h"

#include <algorithm>

#include "slam/common/seconds.h"

namespace aisle::slam {

std::optional<MeasuredMotion> PredictMotion(const TrackMemory& memory, std::int64_t stamp_ns,
                                            const TrackOptions& options) {
  const double gap_s = SecondsBetween(memory.stamp_ns, stamp_ns);
  if (!memory.velocity || gap_s <= 0 || gap_s > options.longest_gap_s) return std::nullopt;
  return Carry(*memory.velocity, gap_s, options.inertia);
}

Eigen::Isometry3d ReckonedPose(const Map& map, const TrackMemory& memory, std::int64_t stamp_ns,
                               const TrackOptions& options) {
  if (map.empty()) return Eigen::Isometry3d::Identity();
  const double gap_s = SecondsBetween(memory.stamp_ns, stamp_ns);
  return PredictPose(memory.PoseIn(map), memory.motion, std::min(gap_s, options.longest_gap_s));
}

}  // namespace aisle::slam
