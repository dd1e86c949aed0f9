#pragma once

#include <Eigen/Geometry>

namespace aisle {

/// Positions are metres, at most so far from the origin, twice around the Earth: beyond, a double
/// leaves less than the micrometre that errors are told to, and squares of it drown everything
/// else.
inline constexpr double kFarthest_m = 1e8;

/// Whether it is a rotation, to a tolerance of its rows' products, and a position within reach.
inline bool IsRigid(const Eigen::Isometry3d& pose, double tolerance) {
  const Eigen::Matrix3d R = pose.linear();
  return pose.matrix().allFinite() && pose.translation().cwiseAbs().maxCoeff() <= kFarthest_m &&
         (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= tolerance &&
         R.determinant() > 0;
}

}  // namespace aisle
