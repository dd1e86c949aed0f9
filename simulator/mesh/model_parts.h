#pragma once

#include <utility>
#include <vector>

#include "simulator/mesh/import.h"

namespace aisle::sim {

/// Triangles of one material that follow one node, or the joints of one skin, as a file has them.
struct MeshPart {
  std::vector<Eigen::Vector3f> positions;
  /// Per position, or empty; what is missing, zero or not finite is computed from the triangles.
  std::vector<Eigen::Vector3f> normals;
  std::vector<Eigen::Vector2f> uvs;                     ///< per position, or empty: zeros
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices into the positions
  std::size_t material = 0;
  bool mirrored = false;           ///< by its nodes: its triangles are to be turned over
  int node = 0;                    ///< that a part without joints follows
  std::vector<ModelJoint> joints;  ///< the nodes must be in the model already
  /// Per position: weight and joint (a place in `joints`), unsorted; empty without joints.
  std::vector<std::vector<std::pair<float, std::uint16_t>>> pulls;
};

/// Appends a part to the model. Of a vertex's weights the four heaviest are kept, scaled so that
/// they sum to 1; equal ones in the order of their joints. Throws ImportError when an index is out
/// of range, a number is not finite, weights are negative or all 0, or a limit is passed.
void AddPart(const MeshPart& part, const ImportOptions& options, Model* model);

/// Fills `model->mesh.positions` and normals with the rest pose and holds the whole to CheckModel.
/// Throws ImportError.
void FinishModel(const ImportOptions& options, Model* model);

}  // namespace aisle::sim
