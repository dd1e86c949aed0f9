#include "harness/ros/geometry.h"

#include "harness/ros/cdr.h"

namespace aisle::ros {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

Quaternion QuaternionOf(const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond q(rotation);
  return {.x = q.x(), .y = q.y(), .z = q.z(), .w = q.w()};
}

Eigen::Isometry3d Isometry(const Eigen::Vector3d& place, const Quaternion& turn) {
  constexpr double kTolerance = 0.05;
  const Eigen::Quaterniond q(turn.w, turn.x, turn.y, turn.z);
  if (!place.allFinite() || !(std::abs(q.norm() - 1) <= kTolerance)) {
    throw CdrError(
        "has an invalid pose: a number is not finite, or its quaternion is not a rotation");
  }
  if (place.cwiseAbs().maxCoeff() > kMostCoordinate_m) {
    throw CdrError(
        fmt::format("has an invalid pose: the position {:g} {:g} {:g} is further than {:g} m from "
                    "the origin; expected metres",
                    place.x(), place.y(), place.z(), kMostCoordinate_m));
  }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = q.normalized().toRotationMatrix();
  pose.translation() = place;
  return pose;
}

}  // namespace

Time TimeOf(std::int64_t stamp_ns) {
  const std::int64_t nanosec = ((stamp_ns % kSecond) + kSecond) % kSecond;
  return {.sec = static_cast<std::int32_t>((stamp_ns - nanosec) / kSecond),
          .nanosec = static_cast<std::uint32_t>(nanosec)};
}

Duration DurationOf(std::int64_t duration_ns) {
  const Time time = TimeOf(duration_ns);
  return {.sec = time.sec, .nanosec = time.nanosec};
}

std::int64_t NanosecondsOf(const Time& time) { return time.sec * kSecond + time.nanosec; }

Pose PoseOf(const Eigen::Isometry3d& T_frame_body) {
  const Eigen::Vector3d p = T_frame_body.translation();
  return {.position = {.x = p.x(), .y = p.y(), .z = p.z()},
          .orientation = QuaternionOf(T_frame_body.linear())};
}

Transform TransformOf(const Eigen::Isometry3d& T_parent_child) {
  const Eigen::Vector3d p = T_parent_child.translation();
  return {.translation = {.x = p.x(), .y = p.y(), .z = p.z()},
          .rotation = QuaternionOf(T_parent_child.linear())};
}

Eigen::Isometry3d IsometryOf(const Pose& pose) {
  return Isometry({pose.position.x, pose.position.y, pose.position.z}, pose.orientation);
}

Eigen::Isometry3d IsometryOf(const Transform& transform) {
  const Vector3& p = transform.translation;
  return Isometry({p.x, p.y, p.z}, transform.rotation);
}

}  // namespace aisle::ros
