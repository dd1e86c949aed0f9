#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "simulator/mesh/material.h"
#include "simulator/mesh/triangle_mesh.h"
#include "simulator/scene/scene.h"

namespace aisle::sim {

/// What a thing is; the values are written into label images, so they never change meaning.
enum class ObjectClass : std::uint8_t {
  kNone = 0,  ///< nothing was hit
  kFloor = 1,
  kWall = 2,
  kColumn = 3,
  kRack = 4,
  kGoods = 5,  ///< pallets, cartons, drums, totes
  kLuminaire = 6,
  kFurniture = 7,  ///< signs, doors, conveyors, all else that is bolted down
  kPerson = 8,
  kForklift = 9,
  kAgv = 10,
  kPalletJack = 11,
  kCar = 12,
  kCyclist = 13,
};

/// One labelled thing. Its id is its index in World::instances(); 0 is "nothing".
struct Instance {
  std::string name;
  ObjectClass object_class = ObjectClass::kNone;
  bool is_actor = false;  ///< may move at some time: a person, a vehicle
};

/// A rectangular area light: the points center + a·half_u + b·half_v, a and b in [-1, 1]. It shines
/// to the side of half_u × half_v with the same radiance in all directions. Its visible surface is
/// part of the static mesh.
struct AreaLight {
  Eigen::Vector3f center, half_u, half_v;  ///< metres, world
  float radiance = 1.0f;                   ///< relative units
};

/// What never moves, in world coordinates.
struct StaticWorld {
  TriangleMesh mesh;                     ///< world frame
  std::vector<std::uint16_t> instances;  ///< per triangle: index into World::instances()
};

/// One mover at one instant. Vertices follow the topology of World::mover_mesh() of the same index.
struct MoverState {
  std::uint16_t instance = 0;
  std::vector<Eigen::Vector3f> positions;   ///< metres, world
  std::vector<Eigen::Vector3f> normals;     ///< unit, world
  std::vector<Eigen::Vector3f> velocities;  ///< m/s, world: each vertex's own, gait included
  Eigen::Isometry3d T_world_object =
      Eigen::Isometry3d::Identity();                       ///< z up, x ahead, on the floor
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();  ///< of the object's origin
};

/// The moving part of the world at one instant.
struct Snapshot {
  std::int64_t stamp_ns = 0;
  std::vector<MoverState> movers;  ///< in the order of World::mover_meshes()
  std::vector<float> light_scale;  ///< per light: 1 as built, 0 switched off
};

/// The scene, laid out: immutable once built, shared by any number of threads. A pure function of
/// (scene file, assets, seed).
class World {
 public:
  /// Lays out the scene. `assets_dir` is where meshes and textures named by the scene are found;
  /// nothing outside it or the scene's own folder is opened. Throws SceneError (file, line, what,
  /// fix) for anything missing or broken.
  static World Build(const Scene& scene, const std::string& assets_dir, std::uint64_t seed);

  World(World&&) noexcept;
  World& operator=(World&&) noexcept;
  ~World();

  const std::vector<Instance>& instances() const;
  const std::vector<Material>& materials() const;
  const std::vector<Texture>& textures() const;
  const std::vector<AreaLight>& lights() const;
  const StaticWorld& statics() const;
  /// Topology, uvs and materials of each mover; positions and normals are those of its bind pose.
  const std::vector<TriangleMesh>& mover_meshes() const;

  /// Everything that moves, at `stamp_ns` after the start of the scene. Pure; safe to call from
  /// several threads.
  Snapshot At(std::int64_t stamp_ns) const;

  /// Where the scene's route puts the rig (left camera) at that time: T_world_rig.
  Eigen::Isometry3d PlannedRigPose(std::int64_t stamp_ns) const;

 private:
  struct Impl;
  explicit World(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace aisle::sim
