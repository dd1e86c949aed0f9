#pragma once

#include <cstdint>
#include <vector>

#include "simulator/mesh/triangle_mesh.h"

namespace aisle::sim {

/// The piece of the mesh that each vertex belongs to, named by the piece's first vertex. Vertices
/// are of one piece if triangles join them, or if they lie in the same place (a seam of the
/// texture). A body and the clothes on it are pieces of their own.
std::vector<std::uint32_t> PiecesOf(const TriangleMesh& mesh);

}  // namespace aisle::sim
