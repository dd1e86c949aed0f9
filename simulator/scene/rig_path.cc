#include "simulator/scene/rig_path.h"

#include <cmath>

#include "simulator/motion/recorded_path.h"

namespace aisle::sim {
namespace {

constexpr double kNanosecond_s = 1e-9;

Eigen::Isometry3d Mounted(const RigMount& mount) {
  return RigPose({.position = Eigen::Vector2d::Zero(), .heading_rad = 0}, mount, {}, 0);
}

/// From what a trajectory's poses are of to the camera that is shown.
Eigen::Isometry3d CameraOnBody(const RigSpec& rig) {
  if (rig.body == TrajectoryBody::kVehicle) return Mounted(rig.mount);
  if (!rig.first_mount) return Eigen::Isometry3d::Identity();
  return Mounted(*rig.first_mount).inverse() *
         Mounted(rig.mount);  // the poses are the other pair's
}

}  // namespace

std::function<Eigen::Isometry3d(std::int64_t)> RigPathOf(const Scene& scene) {
  const RigSpec& rig = scene.rig;
  if (!rig.poses.empty()) {
    return [path = RecordedPath(rig.poses), T_body_rig = CameraOnBody(rig)](std::int64_t stamp_ns) {
      return path.At(stamp_ns) * T_body_rig;
    };
  }
  return [route = Route(rig.route.plan, rig.route.limits), mount = rig.mount,
          bumps = rig.bumps](std::int64_t stamp_ns) {
    const double time_s = static_cast<double>(stamp_ns) * kNanosecond_s;
    return RigPose(route.At(time_s), mount, bumps, time_s);
  };
}

std::function<RouteState(double)> RigFloorOf(const Scene& scene) {
  const RigSpec& rig = scene.rig;
  if (rig.poses.empty()) {
    return [route = Route(rig.route.plan, rig.route.limits)](double time_s) {
      return route.At(time_s);
    };
  }
  const int ahead = rig.body == TrajectoryBody::kVehicle ? 0 : 2;  // axis that looks ahead
  return [path = RecordedPath(rig.poses), ahead](double time_s) {
    const Eigen::Isometry3d pose = path.At(std::llround(time_s / kNanosecond_s));
    RouteState state;
    state.position = pose.translation().head<2>();
    state.heading_rad = std::atan2(pose.linear()(1, ahead), pose.linear()(0, ahead));
    return state;
  };
}

}  // namespace aisle::sim
