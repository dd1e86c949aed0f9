#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

#include "slam/camera/se3.h"

namespace aisle::slam {

/// How the rig moved between the last two tracked frames, per second.
struct Motion {
  Vector6d per_second = Vector6d::Zero();  ///< of T_rig_world; see Retract
};

/// Motion from one pose to the next, `seconds` later. Nothing where no time has passed.
std::optional<Motion> EstimateMotion(const Eigen::Isometry3d& T_world_before,
                                     const Eigen::Isometry3d& T_world_after, double seconds);

/// A motion that forgets: `steady` drawn towards `latest`, by half in `half_life_s`. One step's
/// motion is mostly noise once it is carried on for seconds.
Motion Smoothed(const std::optional<Motion>& steady, const Motion& latest, double seconds,
                double half_life_s);

/// The pose after going on like that for `seconds`; standing still without a motion or time.
Eigen::Isometry3d PredictPose(const Eigen::Isometry3d& T_world_rig,
                              const std::optional<Motion>& motion, double seconds);

}  // namespace aisle::slam
