#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

namespace aisle {

/// A place and a heading on the floor: metres, and radians counter-clockwise from x. Composed like
/// any pose: T_world_b = T_world_a * T_a_b.
struct FloorPose {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double heading_rad = 0;

  Eigen::Vector2d ahead() const { return {std::cos(heading_rad), std::sin(heading_rad)}; }
  Eigen::Vector2d left() const { return {-std::sin(heading_rad), std::cos(heading_rad)}; }
  /// A point given in this frame.
  Eigen::Vector2d operator*(const Eigen::Vector2d& point) const {
    return position + point.x() * ahead() + point.y() * left();
  }
  FloorPose operator*(const FloorPose& next) const {
    return {*this * next.position, heading_rad + next.heading_rad};
  }
  FloorPose inverse() const {
    return {{-position.dot(ahead()), -position.dot(left())}, -heading_rad};
  }
  bool operator==(const FloorPose&) const = default;
};

/// An angle brought to (-pi, pi].
inline double WrapAngle(double angle) {
  const double turns = std::ceil((angle - std::numbers::pi) / (2 * std::numbers::pi));
  return angle - 2 * std::numbers::pi * turns;
}

/// The pose in space of a frame that stands on the floor, z up, x ahead.
inline Eigen::Isometry3d InSpace(const FloorPose& pose) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::AngleAxisd(pose.heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  T.translation() << pose.position.x(), pose.position.y(), 0;
  return T;
}

/// A pose in space seen from above; its heading is that of its x axis, in (-pi, pi].
inline FloorPose FromAbove(const Eigen::Isometry3d& T) {
  return {T.translation().head<2>(), std::atan2(T.linear()(1, 0), T.linear()(0, 0))};
}

}  // namespace aisle
