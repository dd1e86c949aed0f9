#include "slam/foresight.h"

namespace aisle::slam {

std::optional<Eigen::Isometry3d> ForeseeMotion(const TrackMemory& memory, std::int64_t stamp_ns,
                                               const TrackOptions& options) {
  const double gap_s = static_cast<double>(stamp_ns - memory.stamp_ns) * 1e-9;
  if (!memory.motion || gap_s <= 0 || gap_s > options.longest_gap_s) return std::nullopt;
  return PredictPose(Eigen::Isometry3d::Identity(), memory.motion, gap_s).inverse();
}

std::vector<KnownPoint> RecallPoints(const Map& map, const TrackMemory& memory) {
  const Eigen::Isometry3d T_rig_world =
      (map.PoseOf(memory.reference) * memory.T_reference_rig).inverse();
  std::vector<KnownPoint> points;
  points.reserve(memory.landmarks.size());
  for (const LandmarkId id : memory.landmarks) {
    const Landmark* landmark = map.Find(id);
    if (!landmark) continue;
    const KeyframeId first = landmark->observations.front().keyframe;
    const std::int64_t age_ns = memory.stamp_ns - map.At(first).frame->stamp_ns;
    // A keyframe of an earlier drive may carry a later stamp: its clock was another.
    constexpr double kEarlierDrive_s = 3600;
    const double age_s = age_ns < 0 ? kEarlierDrive_s : static_cast<double>(age_ns) * 1e-9;
    points.push_back({T_rig_world * landmark->position, age_s});
  }
  return points;
}

}  // namespace aisle::slam
