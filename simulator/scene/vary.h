#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "simulator/scene/scene.h"

namespace aisle::sim {

/// Suites run these seeds unless told otherwise; a scene is checked for each.
constexpr std::uint64_t kUsualSeeds = 9;

/// The same scene, its trailers with the way of the vehicles that tow them, and what is pushed with
/// the route of who pushes it.
Scene Coupled(Scene scene);

/// The scene as a seed has it: actors set out earlier or later, faster or slower and take other
/// ways, within the bounds their `vary` gives. Coupled. Where halls vary it is in one of
/// them: seed 1 in the first, each further seed in the next, round the list.
Scene Seeded(Scene scene, std::uint64_t seed);

/// The scene with the looks a seed deals to those whose `vary` says so: seed 1 leaves them as
/// written, each further seed moves them on by one round the circle of `models` that nobody wears
/// for good, so that no two who differ become alike. `models` is sorted.
Scene WithLooks(Scene scene, std::uint64_t seed, const std::vector<std::string>& models);

}  // namespace aisle::sim
