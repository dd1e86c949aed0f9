#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "simulator/motion/rig_mount.h"
#include "simulator/motion/route_limits.h"
#include "simulator/scene/drive_spec.h"
#include "simulator/world/ground.h"

namespace aisle::sim {

/// A scene as a vehicle that is steered meets it: which vehicle, what is around it, where its
/// camera is. Frames of reference and units are those of simulator/frames.h; the vehicle's frame
/// lies on the floor, x ahead, y left, z up. Pure once made.
class Site {
 public:
  /// `scene` is one seed's (Seeded); `world` is what was built of it.
  Site(const Scene& scene, const World& world);

  /// What the scene's `drive` says; `there` is false where it has none.
  const DriveSpec& drive() const { return drive_; }
  /// The scene seen from above: way, things, actors. Things and actors only where it has a `drive`.
  const Ground& ground() const { return ground_; }
  /// What the planned way may ask of the rig.
  const RouteLimits& limits() const { return limits_; }
  /// T_vehicle_rig: where the camera is mounted, without any jolt.
  Eigen::Isometry3d Mount() const;
  /// T_world_rig of the rig's vehicle at a place of the floor; its jolts are those of that time.
  Eigen::Isometry3d RigPoseAt(const GroundPose& vehicle, std::int64_t stamp_ns) const;

 private:
  DriveSpec drive_;
  Ground ground_;
  RouteLimits limits_;
  RigMount mount_;
  std::vector<Bump> bumps_;
};

}  // namespace aisle::sim
