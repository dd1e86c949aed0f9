#include "slam/track/motion_model.h"

namespace aisle::slam {

std::optional<Motion> EstimateMotion(const Eigen::Isometry3d& T_world_before,
                                     const Eigen::Isometry3d& T_world_after, double seconds) {
  if (!(seconds > 0)) return std::nullopt;
  return Motion{Difference(T_world_before.inverse(), T_world_after.inverse()) / seconds};
}

Eigen::Isometry3d PredictPose(const Eigen::Isometry3d& T_world_rig,
                              const std::optional<Motion>& motion, double seconds) {
  if (!motion || !(seconds > 0)) return T_world_rig;
  return Retract(T_world_rig.inverse(), motion->per_second * seconds).inverse();
}

}  // namespace aisle::slam
