#pragma once

#include <Eigen/Core>

namespace aisle::sim {

/// A place that receives light: position, and the unit normal of the side it faces; world.
struct SurfacePoint {
  Eigen::Vector3f position, normal;
};

}  // namespace aisle::sim
