#pragma once

#include <cstdint>
#include <vector>

#include "simulator/mesh/triangle_mesh.h"

namespace aisle::sim {

/// 1 for each triangle that lies in the plane of a larger one of the mesh, to a tenth of a
/// millimetre, and covers a part of it: the underside of a carton on its pallet. Of equally large
/// ones all but the first. So among triangles that cover one spot of a plane only one has 0.
std::vector<std::uint8_t> FindOverlapped(const TriangleMesh& mesh);

}  // namespace aisle::sim
