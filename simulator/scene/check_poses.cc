#include "simulator/scene/check_poses.h"

#include <fmt/format.h>

#include <algorithm>

namespace aisle::sim {
namespace {

constexpr double kCosOfMostLean = 0.4226;  // 65 degrees: more than any camera is pitched by a scene

/// From what the poses are of to the vehicle beneath, whose up is then judged.
Eigen::Matrix3d VehicleOnBody(const RigSpec& rig) {
  if (rig.body == TrajectoryBody::kVehicle) return Eigen::Matrix3d::Identity();
  const RouteState at_origin{.position = Eigen::Vector2d::Zero(), .heading_rad = 0};
  return RigPose(at_origin, rig.first_mount.value_or(rig.mount), {}, 0).linear().transpose();
}

constexpr const char* kOrder = "a TUM line is 'seconds tx ty tz qx qy qz qw', with qw last";

std::string LeaningInWords(TrajectoryBody body) {
  if (body == TrajectoryBody::kVehicle) {
    return fmt::format(
        "the vehicle lies on its side or upside down: {}; for poses of a camera (x right, y down, "
        "z ahead), set trajectory_of: camera",
        kOrder);
  }
  return fmt::format(
      "the camera looks straight up or down, or lies on its side or upside down: for poses of a "
      "vehicle (x ahead, z up), set trajectory_of: vehicle; {}; if it is mounted so, set "
      "camera_pitch_deg and camera_roll_deg",
      kOrder);
}

}  // namespace

std::string PosesError(const Scene& scene) {
  const RigSpec& rig = scene.rig;
  const auto last_ns = static_cast<std::int64_t>(1e9 * (scene.frames - 1) / scene.rate_hz);
  const auto end = std::ranges::find_if(
      rig.poses, [&](const TimedPose& pose) { return pose.time_ns > last_ns; });
  const auto count = [&](const auto& is) { return std::count_if(rig.poses.begin(), end, is); };
  const auto all = end - rig.poses.begin();

  const Eigen::Vector3d up = VehicleOnBody(rig).col(2);
  const auto leaning = count([&](const TimedPose& pose) {
    return pose.T_world_body.linear().row(2).dot(up) < kCosOfMostLean;
  });
  if (2 * leaning > all) {
    return fmt::format("in {} of {} poses {}", leaning, all, LeaningInWords(rig.body));
  }
  const bool is_mounted = rig.body == TrajectoryBody::kVehicle;
  const Eigen::Vector3d camera(0, 0, is_mounted ? rig.mount.height_m : 0);
  const auto below =
      count([&](const TimedPose& pose) { return (pose.T_world_body * camera).z() <= 0; });
  if (2 * below <= all) return "";
  return fmt::format(
      "in {} of {} poses the camera is on or below the floor: coordinates must be the scene's, "
      "with z up from the floor; for poses of a vehicle, set trajectory_of: vehicle",
      below, all);
}

}  // namespace aisle::sim
