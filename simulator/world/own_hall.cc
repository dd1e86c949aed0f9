#include "simulator/world/own_hall.h"

#include <map>
#include <stdexcept>

#include "simulator/mesh/still.h"
#include "simulator/scene/rig_path.h"
#include "simulator/world/labels.h"
#include "simulator/world/shell.h"

namespace aisle::sim {
namespace {

constexpr std::size_t kMostNodes = 60'000;  ///< instances are counted in 16 bits

/// Appends the triangles of a list with their vertices, in their order.
void AddTriangles(const TriangleMesh& from, const std::vector<std::size_t>& triangles,
                  TriangleMesh* to) {
  std::map<std::uint32_t, std::uint32_t> moved;
  for (const std::size_t triangle : triangles) {
    std::array<std::uint32_t, 3> corners = from.triangles[triangle];
    for (std::uint32_t& corner : corners) {
      const auto [entry, is_new] =
          moved.try_emplace(corner, static_cast<std::uint32_t>(to->positions.size()));
      if (is_new) {
        to->positions.push_back(from.positions[corner]);
        to->normals.push_back(from.normals[corner]);
        to->uvs.push_back(from.uvs[corner]);
      }
      corner = entry->second;
    }
    to->triangles.push_back(corners);
    to->materials.push_back(from.materials[triangle]);
  }
}

}  // namespace

void AddOwnHall(const Scene& scene, AssetLibrary* assets, Wardrobe* wardrobe,
                WorldBuilder* builder) {
  const std::shared_ptr<const Model> hall = assets->LoadStill(scene.hall.mesh.file);
  TriangleMesh mesh = wardrobe->Wear(hall);
  std::map<int, std::vector<std::size_t>> of_node;
  const std::vector<int> nodes = NodesOfTriangles(*hall);
  TurnShellInside(RigPathOf(scene)(0).translation().cast<float>(), nodes, &mesh);
  for (std::size_t i = 0; i < nodes.size(); ++i) of_node[nodes[i]].push_back(i);
  if (of_node.size() > kMostNodes) {
    throw std::runtime_error(
        fmt::format("{}: hall.mesh: {} nodes show something, and {} can be told apart; join some",
                    PlaceText(scene.files, scene.hall.mesh.mark), of_node.size(), kMostNodes));
  }
  for (const auto& [node, triangles] : of_node) {
    const std::string& name = hall->nodes[static_cast<std::size_t>(node)].name;
    builder->Add(name.empty() ? fmt::format("hall_{}", node) : name,
                 ClassOfLabel(LabelOfNode(name, scene.hall.labels)),
                 [&](TriangleMesh* to) { AddTriangles(mesh, triangles, to); });
  }
}

}  // namespace aisle::sim
