#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulator/trace/rays.h"

namespace aisle::sim {

/// The i-th point of the R2 sequence (Roberts 2018), evenly spread over the unit square.
Eigen::Vector2f SpreadPoint(int i);

/// Local directions (z = normal) whose density is the cosine.
std::vector<Eigen::Vector3f> CosineDirections(int count);
/// Directions evenly over the sphere.
std::vector<Eigen::Vector3f> SphereDirections(int count);

/// A basis whose third axis is the unit vector n (Duff et al. 2017).
Eigen::Matrix3f BasisAround(const Eigen::Vector3f& n);

/// Fills lane k: from the origin along the direction, as far as t_far.
void SetRay(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float t_far, int k,
            Rays8* rays);

}  // namespace aisle::sim
