#include "simulator/shade/pass/mover_light.h"

#include <algorithm>

#include "simulator/common/parallel.h"
#include "simulator/shade/light/direct_light.h"
#include "simulator/shade/pass/emitter_shadows.h"
#include "simulator/shade/pass/mover_indirect.h"
#include "simulator/shade/surface/mesh_pieces.h"

namespace aisle::sim {
namespace {

float FloorUnder(const World& world) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& position : world.statics().mesh.positions) box.extend(position);
  return FloorOf(box);
}

/// One point's irradiance: each emitter's unshadowed light times the share of it that the point
/// sees, which the nodes around know.
float DirectAt(const SurfacePoint& place, const Emitters& emitters,
               std::span<const std::uint32_t> near, std::span<const float> light_scale,
               const EmitterVisibility& visible, const MoverNodes::Stencil& stencil,
               std::span<const std::uint32_t> row_of_node) {
  F8 sum = Wide(0);
  for (std::size_t i = 0; i < emitters.stride(); i += kLanes) {
    const F8 unshadowed = emitters.Unshadowed(place, light_scale, i, near);
    if (!Any(unshadowed > 0)) continue;
    F8 seen = Wide(0), weights = Wide(0);
    for (std::size_t k = 0; k < MoverNodes::kNeighbours; ++k) {
      const float weight = stencil.weights[k];
      if (weight <= 0) continue;
      const F8 value = LoadF(&visible.Row(row_of_node[stencil.nodes[k]])[i]);
      const I8 above = value >= 0;
      seen += Select(above, weight * value, Wide(0));
      weights += Select(above, Wide(weight), Wide(0));
    }
    sum += unshadowed * seen / Max(weights, Wide(1e-9f));
  }
  return Sum(sum);
}

float KeptAt(std::span<const float> kept, const MoverNodes::Stencil& stencil,
             std::span<const std::uint32_t> row_of_node) {
  float sum = 0;
  for (std::size_t k = 0; k < MoverNodes::kNeighbours; ++k) {
    if (stencil.weights[k] > 0) sum += stencil.weights[k] * kept[row_of_node[stencil.nodes[k]]];
  }
  return sum;
}

}  // namespace

MoverLight::MoverLight(const World& world, std::span<const LightGrid> grids,
                       const MoverLightOptions& options)
    : world_(world),
      grids_(grids),
      options_(options),
      floor_z_(FloorUnder(world)),
      emitters_(world.lights(), floor_z_),
      statics_(emitters_, world.statics().mesh, options.statics) {
  for (std::size_t i = 0; i < grids.size(); ++i) {
    const TriangleMesh& mesh = world.mover_meshes()[i];
    const std::vector<std::uint32_t> piece_of_vertex = PiecesOf(mesh);
    Body& body = bodies_.emplace_back();
    body.bound = LocatePoints(grids[i], mesh, mesh.positions, mesh.normals);
    for (const LightPoint& point : grids[i].points) {
      body.pieces.push_back(piece_of_vertex[mesh.triangles[point.triangle][0]]);
    }
  }
}

const MoverNodes& MoverLight::NodesFor(std::size_t mover, float pixel_m) const {
  std::size_t level = 0;
  while (level + 1 < kSpacings.size() &&
         kSpacings[level + 1] <= options_.pixels_per_node * pixel_m) {
    ++level;
  }
  Body& body = bodies_[mover];
  std::call_once(body.chosen[level], [&] {
    body.levels[level] = ChooseNodes(body.bound, body.pieces, kSpacings[level]);
  });
  return body.levels[level];
}

MoverLight::NodeLight MoverLight::LightNodes(const Instant& instant, std::size_t mover,
                                             const LightVolume& volume, const MoverNodes& nodes,
                                             std::span<const std::uint32_t> used) const {
  const MoverState& state = instant.snapshot().movers[mover];
  const TriangleMesh& mesh = world_.mover_meshes()[mover];
  const LightGrid& grid = grids_[mover];
  const Eigen::AlignedBox3f& box = instant.mover_boxes()[mover];
  std::vector<ShadowedPlace> places;
  std::vector<Eigen::Vector3f> tangents;
  for (const std::uint32_t node : used) {
    const std::uint32_t point = nodes.points[node];
    places.push_back({LocatePoint(grid, point, mesh, state.positions, state.normals), node});
    const auto& [a, b, c] = mesh.triangles[grid.points[point].triangle];
    tangents.push_back(state.positions[b] - state.positions[a]);
  }
  const std::vector<EmitterRays> plan = PlanEmitterRays(instant, emitters_, box, kMoversOnly);
  NodeLight light{.visible = TraceMoverShadowsOn(instant, emitters_, plan, places), .kept = {}};
  statics_.Shade(instant, places, &light.visible);
  const MoverIndirect indirect(instant, emitters_, statics_, volume, mover, floor_z_);
  light.kept.resize(places.size());
  ParallelFor(std::size_t{0}, places.size(),
              [&](std::size_t i) { light.kept[i] = indirect.KeptAt(places[i], tangents[i]); });
  return light;
}

std::vector<float> MoverLight::At(const Instant& instant, std::size_t mover,
                                  const LightVolume& volume, std::span<const std::uint8_t> wanted,
                                  float pixel_m) const {
  const MoverState& state = instant.snapshot().movers[mover];
  const TriangleMesh& mesh = world_.mover_meshes()[mover];
  const MoverNodes& nodes = NodesFor(mover, pixel_m);
  std::vector<std::uint32_t> row_of_node(nodes.points.size());
  std::vector<std::uint32_t> used, points;
  for (std::uint32_t i = 0; i < wanted.size(); ++i) {
    if (!wanted[i]) continue;
    points.push_back(i);
    for (std::size_t k = 0; k < MoverNodes::kNeighbours; ++k) {
      if (nodes.stencils[i].weights[k] > 0) row_of_node[nodes.stencils[i].nodes[k]] = 1;
    }
  }
  for (const std::uint32_t node : nodes.in_order) {
    if (!row_of_node[node]) continue;
    row_of_node[node] = static_cast<std::uint32_t>(used.size());
    used.push_back(node);
  }
  const NodeLight light = LightNodes(instant, mover, volume, nodes, used);
  const std::vector<std::uint32_t> near = emitters_.NearTo(instant.mover_boxes()[mover]);
  std::vector<float> result(wanted.size(), -1);
  ParallelFor(std::size_t{0}, points.size(), [&](std::size_t i) {
    const std::uint32_t point = points[i];
    const SurfacePoint place =
        LocatePoint(grids_[mover], point, mesh, state.positions, state.normals);
    const MoverNodes::Stencil& stencil = nodes.stencils[point];
    result[point] =
        DirectAt(place, emitters_, near, instant.snapshot().light_scale, light.visible, stencil,
                 row_of_node) +
        volume.Irradiance(place.position, place.normal) * KeptAt(light.kept, stencil, row_of_node);
  });
  return result;
}

}  // namespace aisle::sim
