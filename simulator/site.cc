#include "simulator/site.h"

namespace aisle::sim {

Site::Site(const Scene& scene, const World& world)
    : drive_(scene.drive),
      ground_(scene, world),
      limits_(scene.rig.route.limits),
      mount_(scene.rig.mount),
      bumps_(scene.rig.bumps) {}

Eigen::Isometry3d Site::Mount() const {
  return RigPose({.position = Eigen::Vector2d::Zero(), .heading_rad = 0}, mount_, {}, 0);
}

Eigen::Isometry3d Site::RigPoseAt(const GroundPose& vehicle, std::int64_t stamp_ns) const {
  return RigPose({.position = vehicle.position, .heading_rad = vehicle.heading_rad}, mount_, bumps_,
                 1e-9 * static_cast<double>(stamp_ns));
}

}  // namespace aisle::sim
