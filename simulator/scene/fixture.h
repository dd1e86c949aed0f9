#pragma once

#include <Eigen/Geometry>

#include "simulator/scene/scene.h"

namespace aisle::sim {

/// How large a fixture is: depth along its front's direction, length across, and its height: its
/// top, or the underside of what hangs.
Eigen::Vector3d SizeOf(const FixtureSpec& fixture);

/// The rectangle in its own frame, x to its front and y to its left, that holds what it has between
/// shin and head height: bins, rails and handles stand out of SizeOf.
Eigen::AlignedBox2d FootprintOf(const FixtureSpec& fixture);

/// Whether nobody can pass where it is: it stands there, and is no curtain and nothing flat.
bool Blocks(const FixtureSpec& fixture);

}  // namespace aisle::sim
