#include "simulator/world/world.h"

#include <algorithm>
#include <stdexcept>

#include "simulator/common/parallel.h"

namespace aisle::sim {
namespace {

void CheckMesh(const TriangleMesh& mesh, const WorldParts& parts, const std::string& name) {
  const std::size_t vertices = mesh.positions.size();
  if (mesh.normals.size() != vertices || mesh.uvs.size() != vertices) {
    throw std::invalid_argument(fmt::format(
        "{}: {} positions but {} normals and {} uvs; there must be one of each a vertex", name,
        vertices, mesh.normals.size(), mesh.uvs.size()));
  }
  if (mesh.materials.size() != mesh.triangles.size()) {
    throw std::invalid_argument(fmt::format("{}: {} triangles but {} material indices", name,
                                            mesh.triangles.size(), mesh.materials.size()));
  }
  for (const Eigen::Vector3f& position : mesh.positions) {
    if (!position.allFinite()) throw std::invalid_argument(name + ": a vertex is not finite");
  }
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t index : triangle) {
      if (index >= vertices) {
        throw std::invalid_argument(
            fmt::format("{}: a triangle names vertex {}, there are {}", name, index, vertices));
      }
    }
  }
  for (const std::uint16_t material : mesh.materials) {
    if (material >= parts.materials.size()) {
      throw std::invalid_argument(fmt::format("{}: a triangle names material {}, there are {}",
                                              name, material, parts.materials.size()));
    }
  }
}

std::vector<ActorClock> ClocksNear(const Snapshot& snapshot, std::int64_t offset_ns) {
  std::vector<ActorClock> clocks = snapshot.clocks;
  for (ActorClock& clock : clocks) clock = clock.After(offset_ns);
  return clocks;
}

}  // namespace

std::string_view ClassName(ObjectClass object_class) {
  constexpr std::array<std::string_view, 14> kNames = {
      "none",      "floor",  "wall",     "column", "rack",        "goods", "luminaire",
      "furniture", "person", "forklift", "agv",    "pallet_jack", "car",   "cyclist"};
  return kNames.at(static_cast<std::size_t>(object_class));
}

float FloorOf(const Eigen::AlignedBox3f& statics) {
  return statics.isEmpty() ? 0 : std::clamp(0.0f, statics.min().z(), statics.max().z());
}

World::World(WorldParts parts) : parts_(std::move(parts)) {
  CheckMesh(parts_.statics.mesh, parts_, "static world");
  if (parts_.statics.instances.size() != parts_.statics.mesh.triangles.size()) {
    throw std::invalid_argument("static world: one instance index is needed per triangle");
  }
  for (const std::uint16_t instance : parts_.statics.instances) {
    if (instance >= parts_.instances.size()) {
      throw std::invalid_argument(
          fmt::format("static world: a triangle names instance {}, there are {}", instance,
                      parts_.instances.size()));
    }
  }
  if (parts_.mover_meshes.size() > kMostMovers) {
    throw std::invalid_argument(fmt::format("{} movers are more than the {} that rays tell apart",
                                            parts_.mover_meshes.size(), kMostMovers));
  }
  for (std::size_t i = 0; i < parts_.mover_meshes.size(); ++i) {
    CheckMesh(parts_.mover_meshes[i], parts_, fmt::format("mover {}", i));
  }
  if (!parts_.mover_meshes.empty() && !parts_.at) {
    throw std::invalid_argument("there are movers, but nothing says where they are");
  }
  if (parts_.lights.empty()) throw std::invalid_argument("there is no light");
}

World World::InBand(std::size_t band) const {
  WorldParts parts = parts_;
  parts.materials = parts_.colour.at(band).materials;
  parts.textures = parts_.colour.at(band).textures;
  parts.colour.clear();
  return World(std::move(parts));
}

Snapshot World::At(std::int64_t stamp_ns) const {
  if (parts_.at) return parts_.at(stamp_ns);
  return {
      .stamp_ns = stamp_ns, .movers = {}, .light_scale = std::vector<float>(lights().size(), 1)};
}

Snapshot World::At(std::int64_t stamp_ns, std::span<const ActorClock> clocks) const {
  if (clocks.empty() || !parts_.at_clocks) return At(stamp_ns);
  return parts_.at_clocks(stamp_ns, clocks);
}

Snapshot World::Near(const Snapshot& snapshot, std::int64_t offset_ns) const {
  return At(snapshot.stamp_ns + offset_ns, ClocksNear(snapshot, offset_ns));
}

std::vector<MoverVelocities> World::VelocitiesNear(const Snapshot& snapshot,
                                                   std::span<const std::int64_t> offsets_ns) const {
  const std::size_t movers = snapshot.movers.size();
  std::vector<MoverVelocities> all(offsets_ns.size(), MoverVelocities(movers));
  if (!parts_.velocities) {
    for (std::size_t k = 0; k < all.size(); ++k) {
      Snapshot then = Near(snapshot, offsets_ns[k]);
      for (std::size_t i = 0; i < movers; ++i) all[k][i] = std::move(then.movers[i].velocities);
    }
    return all;
  }
  ParallelFor(std::size_t{0}, all.size() * movers, [&](std::size_t one) {
    const std::size_t k = one / movers, i = one % movers;
    all[k][i] = parts_.velocities(i, snapshot.stamp_ns + offsets_ns[k],
                                  ClocksNear(snapshot, offsets_ns[k]));
  });
  return all;
}

Eigen::Isometry3d World::PlannedRigPose(std::int64_t stamp_ns) const {
  return parts_.rig ? parts_.rig(stamp_ns) : Eigen::Isometry3d::Identity();
}

}  // namespace aisle::sim
