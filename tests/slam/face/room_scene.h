#pragma once

#include <Eigen/Geometry>
#include <limits>

#include "slam/stereo_slam.h"
#include "tests/slam/stereo/synthetic_view.h"

namespace aisle::slam {

/// A box-shaped room with textured walls, seen from inside: a world whose images and poses are
/// known exactly. World axes are those of a camera: x right, y down, z ahead; metres.
class RoomScene {
 public:
  /// `halved`: images of half the size and twice the baseline, for tests that need many frames.
  explicit RoomScene(bool halved = false) : halved_(halved) {}

  StereoCamera camera() const {
    if (halved_) return {188, 120, 108.8, 108.8, 93.5, 59.5, 0.24};
    return {376, 240, 217.6, 217.6, 187.5, 119.5, 0.12};
  }

  StereoImages See(std::int64_t id, std::int64_t stamp_ns, const Eigen::Isometry3d& T_world_rig,
                   double noise = 2) const {
    Eigen::Isometry3d T_world_right = T_world_rig;
    T_world_right.translate(Eigen::Vector3d(camera().baseline_m, 0, 0));
    const auto seed = static_cast<std::uint64_t>(2 * id + 1);
    return {id, stamp_ns, View(T_world_rig, noise, seed), View(T_world_right, noise, seed + 1)};
  }

 private:
  cv::Mat1b View(const Eigen::Isometry3d& T_world_camera, double noise, std::uint64_t seed) const {
    const StereoCamera c = camera();
    return Render(
        {c.width, c.height},
        [&](double u, double v) {
          return Grey(
              T_world_camera.translation(),
              T_world_camera.linear() * Eigen::Vector3d((u - c.cx) / c.fx, (v - c.cy) / c.fy, 1));
        },
        noise, seed);
  }

  double Grey(const Eigen::Vector3d& centre, const Eigen::Vector3d& ray) const {
    const Eigen::Vector3d low(-3, -1.5, -4), high(3, 1.2, 12);
    double nearest = std::numeric_limits<double>::infinity();
    int wall = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (ray[axis] == 0) continue;
      const double along = ((ray[axis] > 0 ? high : low)[axis] - centre[axis]) / ray[axis];
      if (along < nearest) nearest = along, wall = 2 * axis + (ray[axis] > 0);
    }
    const Eigen::Vector3d hit = centre + nearest * ray;
    const int axis = wall / 2;
    const Texture texture(static_cast<std::uint64_t>(20 + 10 * wall), 0.17);
    return texture(hit[(axis + 1) % 3], hit[(axis + 2) % 3]);
  }

  bool halved_;
};

inline Eigen::Isometry3d PoseAt(double x, double y, double z, double yaw_deg = 0) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << x, y, z;
  pose.linear() = Eigen::AngleAxisd(yaw_deg * M_PI / 180, Eigen::Vector3d::UnitY()).matrix();
  return pose;
}

}  // namespace aisle::slam
