#include "slam/track/close_points.h"

namespace aisle::slam {

ClosePoints CountClosePoints(const Frame& frame, const FramePose& pose, const StereoCamera& camera,
                             double close_baselines) {
  std::vector<bool> tracked(static_cast<std::size_t>(frame.size()), false);
  for (std::size_t i = 0; i < pose.matches.size(); ++i) {
    if (pose.pose.inlier[i]) tracked[static_cast<std::size_t>(pose.matches[i].feature)] = true;
  }
  const double least_disparity = camera.fx / close_baselines;  // f b / (n b)
  ClosePoints close;
  for (std::size_t i = 0; i < tracked.size(); ++i) {
    const Measurement& measurement = frame.measurements[i];
    if (!measurement.has_depth() || measurement.uvd.z() <= least_disparity) continue;
    tracked[i] ? ++close.tracked : ++close.untracked;
  }
  return close;
}

}  // namespace aisle::slam
