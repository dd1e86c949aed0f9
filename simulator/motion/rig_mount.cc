#include "simulator/motion/rig_mount.h"

#include <cmath>
#include <numbers>

namespace aisle::sim {
namespace {

/// 0 before the bump; from there (1 - e^{-2t/d})^2 · e^{-t/d} · sin(wt), which begins as t^3: the
/// acceleration is continuous. Scaled so that the envelope's highest value is 0.77.
double Swing(const Bump& bump, double time_s) {
  const double t = time_s - bump.at_s;
  if (t <= 0) return 0;
  const double rise = 1 - std::exp(-2 * t / bump.decay_s);
  return 2.69 * rise * rise * std::exp(-t / bump.decay_s) *
         std::sin(2 * std::numbers::pi * bump.frequency_hz * t);
}

}  // namespace

Eigen::Matrix3d MountTurn(const RigMount& mount) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  return (AngleAxisd(-mount.yaw_rad, Vector3d::UnitY()) *
          AngleAxisd(-mount.pitch_rad, Vector3d::UnitX()) *
          AngleAxisd(mount.roll_rad, Vector3d::UnitZ()))
      .toRotationMatrix();
}

Eigen::Isometry3d RigPose(const RouteState& state, const RigMount& mount,
                          std::span<const Bump> bumps, double time_s) {
  double height = mount.height_m, pitch = mount.pitch_rad;
  for (const Bump& bump : bumps) {
    height += bump.height_m * Swing(bump, time_s);
    pitch += bump.pitch_rad * Swing(bump, time_s);
  }
  const double c = std::cos(state.heading_rad), s = std::sin(state.heading_rad);
  Eigen::Matrix3d level;  // columns: right, down, forward
  level << s, 0, c, -c, 0, s, 0, -1, 0;
  Eigen::Isometry3d T_world_rig = Eigen::Isometry3d::Identity();
  if (mount.yaw_rad == 0 && mount.roll_rad == 0) {  // one turn, as it has always been summed
    T_world_rig.linear() =
        level * Eigen::AngleAxisd(-pitch, Eigen::Vector3d::UnitX()).toRotationMatrix();
  } else {  // a jolt turns the vehicle, wherever the camera looks
    const Eigen::AngleAxisd jolt(mount.pitch_rad - pitch, Eigen::Vector3d::UnitX());
    T_world_rig.linear() = level * jolt.toRotationMatrix() * MountTurn(mount);
  }
  T_world_rig.translation() << state.position.x() + mount.forward_m * c - mount.left_m * s,
      state.position.y() + mount.forward_m * s + mount.left_m * c, height;
  return T_world_rig;
}

}  // namespace aisle::sim
