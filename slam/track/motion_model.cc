#include "slam/track/motion_model.h"

#include <cmath>

namespace aisle::slam {

std::optional<Motion> EstimateMotion(const Eigen::Isometry3d& T_world_before,
                                     const Eigen::Isometry3d& T_world_after, double seconds) {
  if (!(seconds > 0)) return std::nullopt;
  return Motion{Difference(T_world_before.inverse(), T_world_after.inverse()) / seconds};
}

Motion Smoothed(const std::optional<Motion>& steady, const Motion& latest, double seconds,
                double half_life_s) {
  if (!steady) return latest;
  const double kept = std::exp2(-seconds / half_life_s);
  return {kept * steady->per_second + (1 - kept) * latest.per_second};
}

Eigen::Isometry3d PredictPose(const Eigen::Isometry3d& T_world_rig,
                              const std::optional<Motion>& motion, double seconds) {
  if (!motion || !(seconds > 0)) return T_world_rig;
  return Retract(T_world_rig.inverse(), motion->per_second * seconds).inverse();
}

}  // namespace aisle::slam
