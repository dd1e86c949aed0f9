#pragma once

#include <span>

#include "simulator/mesh/triangle_mesh.h"

namespace aisle::sim {

/// A building as one sees it from `inside`, a place in its free space. Surfaces have light on the
/// side that they are wound to face, and many a modeller's building is a shell wound to be seen
/// from outside: where the mesh as a whole is one (its winding number there, Jacobson et al. 2013,
/// is above a half), those of its parts that turn their backs to the place are turned round. A part
/// is what hangs together by its corners and is of one node (`nodes`, by triangle; no two share a
/// vertex); closed things beside the place, racks and walls with a thickness, stay as they are.
void TurnShellInside(const Eigen::Vector3f& inside, std::span<const int> nodes, TriangleMesh* mesh);

}  // namespace aisle::sim
