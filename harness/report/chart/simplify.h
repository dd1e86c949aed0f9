#pragma once

#include <Eigen/Core>
#include <vector>

namespace aisle {

/// Indices of the points that a line must keep so that it stays within `tolerance` of every point
/// left out (Douglas and Peucker, 1973); rising, the ends always among them. In the plane z is 0.
std::vector<std::size_t> Simplify(const std::vector<Eigen::Vector3d>& points, double tolerance);

}  // namespace aisle
