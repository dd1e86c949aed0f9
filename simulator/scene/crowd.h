#pragma once

#include <cstdint>
#include <stdexcept>

#include "simulator/scene/scene.h"

namespace aisle::sim {

/// A crowd that cannot walk.
class CrowdError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Adds the people of the scene's crowd, as many as its level of dynamics has, with the ways of a
/// seed; see WalkCrowd. The rig's and all others' routes, which are this seed's already, are those
/// of who does not give way. Throws CrowdError.
void AddCrowd(std::uint64_t seed, Scene* scene);

/// How many AddCrowd adds.
int CrowdPeople(const Scene& scene);

/// The part of the floor where they walk: its corners with the smallest and the largest x and y.
struct CrowdArea {
  Eigen::Vector2d from, to;
};
CrowdArea CrowdAreaOf(const Scene& scene);

}  // namespace aisle::sim
