#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

namespace aisle::sim {

struct TimedPose {
  std::int64_t time_ns = 0;
  Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();
};

/// A path through given poses: exactly those at their times, to the bit, and smooth between, with
/// continuous velocity and turn rate. Each knot's are those of its neighbours' chord; between two
/// knots run cubic Hermite curves, of the position and of the rotation vector from the first.
/// Before the first and after the last it goes on with that pose's velocity and turn rate: a
/// recording is cut out of a drive, and what is differenced across its ends must see no stop. A
/// path of a single pose stands.
class RecordedPath {
 public:
  RecordedPath() = default;
  /// Times rise. Throws std::invalid_argument where they do not, or without a pose.
  explicit RecordedPath(std::vector<TimedPose> poses);

  Eigen::Isometry3d At(std::int64_t time_ns) const;
  std::int64_t duration_ns() const { return poses_.back().time_ns - poses_.front().time_ns; }

 private:
  /// Before the first or after the last pose, whose index is `end`.
  Eigen::Isometry3d Beyond(std::size_t end, std::int64_t time_ns) const;

  std::vector<TimedPose> poses_;
  std::vector<Eigen::Vector3d> velocity_mps_;     ///< world
  std::vector<Eigen::Vector3d> turn_rate_rad_s_;  ///< in the body's axes
};

}  // namespace aisle::sim
