#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "simulator/scene/scene.h"

namespace aisle::sim {

/// Each piece of a row is turned by at most so much otherwise than the row says.
inline constexpr double kPropTurn_rad = 0.04;

/// Where the pieces of a row stand; one place without a row.
std::vector<Eigen::Vector2d> PlacesOf(const PropSpec& prop);

/// The rectangle in a piece's own frame that holds what it has between shin and head height: a
/// tree's trunk and not its crown. None where nothing is in the way there: it hangs above heads.
/// None of a mesh of the user's own either, nor of a model that this table does not know.
std::optional<Eigen::AlignedBox2d> FootprintOf(const PropSpec& prop);

}  // namespace aisle::sim
