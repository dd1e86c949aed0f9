#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "simulator/frames.h"
#include "simulator/mesh/material.h"
#include "simulator/mesh/triangle_mesh.h"

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

/// "person", "forklift", …: as label files spell it.
std::string_view ClassName(ObjectClass object_class);

/// One labelled thing. Its id is its index in World::instances(); 0 is "nothing".
struct Instance {
  std::string name;
  ObjectClass object_class = ObjectClass::kNone;
  bool is_actor = false;  ///< may move at some time: a person, a vehicle, a mechanism
};

/// A rectangular area light: the points center + a·half_u + b·half_v, a and b in [-1, 1]. It shines
/// to the side of half_u × half_v with the same radiance in all directions. Its visible surface is
/// part of the static mesh.
struct AreaLight {
  Eigen::Vector3f center, half_u, half_v;  ///< metres, world
  float radiance = 1.0f;                   ///< relative units
};

/// Height on which things stand, in metres, of a static world in this box: 0, as frames have it,
/// whatever footings reach below it; the nearest there is to that where all lies above or below.
float FloorOf(const Eigen::AlignedBox3f& statics);

/// What never moves, in world coordinates.
struct StaticWorld {
  TriangleMesh mesh;                     ///< world frame
  std::vector<std::uint16_t> instances;  ///< per triangle: index into World::instances()
};

/// As many movers as one ray can choose among.
inline constexpr std::size_t kMostMovers = 127;

/// One mover at one instant. Vertices follow the topology of World::mover_mesh() of the same index.
struct MoverState {
  std::uint16_t instance = 0;
  std::vector<Eigen::Vector3f> positions;   ///< metres, world
  std::vector<Eigen::Vector3f> normals;     ///< unit, world
  std::vector<Eigen::Vector3f> velocities;  ///< m/s, world: each vertex's own, gait included
  /// z up, x ahead; on the floor for people and vehicles, at its first moving part for a mechanism.
  Eigen::Isometry3d T_world_object = Eigen::Isometry3d::Identity();
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();  ///< of the object's origin
  /// Per vertex: how often it has come round, as the boxes of a belt do; where two counts differ,
  /// it is not the same thing any more. Empty: it never does.
  std::vector<int> rounds = {};
  bool casts_shadow = true;  ///< false: all of it is seen through, and so it is lit through
};

/// Of every mover the velocities of its vertices, as MoverState has them.
using MoverVelocities = std::vector<std::vector<Eigen::Vector3f>>;

/// A moving light at one instant. It lights straight from where it is, without size: its shadows
/// are sharp but for the sun's own breadth.
struct Beam {
  static constexpr float kHousing_m = 0.2f;        ///< around a spot: its own casts no shadow
  static constexpr float kBeforeWindow_m = 0.12f;  ///< where bars and lintel are
  static constexpr float kSunRadius = 0.004654f;   ///< tangent of half the sun's 0.533 degrees

  enum class Kind { kSpot, kSun } kind = Kind::kSpot;
  Eigen::Vector3f origin = Eigen::Vector3f::Zero();   ///< spot; middle of a window; metres, world
  Eigen::Vector3f toward = Eigen::Vector3f::UnitX();  ///< spot: unit, where it shines; sun: unit,
                                                      ///< up its rays to where it stands
  /// Spot: intensity, radiance units m²; sun: irradiance across its rays.
  float power = 0;
  float cos_inner = 1, cos_outer = 1;  ///< spot: full light within, none beyond
  Eigen::Vector3f half_u = Eigen::Vector3f::Zero(), half_v = Eigen::Vector3f::Zero();  ///< window
  int columns = 1, rows = 1;                                                           ///< of panes
  float bar_u = 0, bar_v = 0;  ///< breadth of bars, shares of a pane
};

/// The moving part of the world at one instant.
struct Snapshot {
  std::int64_t stamp_ns = 0;
  std::vector<MoverState> movers;       ///< in the order of World::mover_meshes()
  std::vector<float> light_scale;       ///< per light: 1 as built, 0 switched off
  std::vector<ActorClock> clocks = {};  ///< per mover; empty: all keep the scene's time
  std::vector<Beam> beams = {};         ///< moving lights that shine now
  float beam_bounce = 0;  ///< irradiance that their light gives everywhere after it met a surface
};

/// What surfaces are like in one band of colour: as many materials and textures as the world has.
struct BandSurfaces {
  std::vector<Material> materials;
  std::vector<Texture> textures;
};

/// The parts a world is made of. BuildWorld (simulator/world/build.h) makes them from a scene file;
/// tests make their own.
struct WorldParts {
  std::vector<Instance> instances = {{"nothing", ObjectClass::kNone, false}};
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<AreaLight> lights;
  StaticWorld statics;
  /// Topology, uvs and materials of each mover; positions and normals are those of its bind pose.
  std::vector<TriangleMesh> mover_meshes;
  /// Everything that moves, at a time after the start of the scene. Pure and thread-safe. None:
  /// nothing moves.
  std::function<Snapshot(std::int64_t stamp_ns)> at;
  /// The same where each mover has a clock of its own. Pure. None: they have no clocks.
  std::function<Snapshot(std::int64_t stamp_ns, std::span<const ActorClock> clocks)> at_clocks = {};
  /// Of one mover then, its vertices' velocities alone. Pure. None: taken from whole snapshots.
  std::function<std::vector<Eigen::Vector3f>(std::size_t mover, std::int64_t stamp_ns,
                                             std::span<const ActorClock> clocks)>
      velocities = {};
  /// Where the route puts the rig (left camera) at a time: T_world_rig. Pure. None: identity.
  std::function<Eigen::Isometry3d(std::int64_t stamp_ns)> rig;
  bool has_beams = false;                 ///< snapshots may have beams
  std::vector<BandSurfaces> colour = {};  ///< red, green, blue; none: the world is grey
  std::uint64_t files_digest = 0;         ///< of the files it was made from, besides the scene's
};

/// The scene, laid out: immutable once built, shared by any number of threads.
class World {
 public:
  /// Throws std::invalid_argument naming the first broken rule (index out of range, array lengths
  /// that differ, NaN positions, no light, more than kMostMovers).
  explicit World(WorldParts parts);

  const std::vector<Instance>& instances() const { return parts_.instances; }
  const std::vector<Material>& materials() const { return parts_.materials; }
  const std::vector<Texture>& textures() const { return parts_.textures; }
  const std::vector<AreaLight>& lights() const { return parts_.lights; }
  const StaticWorld& statics() const { return parts_.statics; }
  const std::vector<TriangleMesh>& mover_meshes() const { return parts_.mover_meshes; }
  bool has_beams() const { return parts_.has_beams; }
  const std::vector<BandSurfaces>& colour() const { return parts_.colour; }
  bool has_colour() const { return !parts_.colour.empty(); }
  std::uint64_t files_digest() const { return parts_.files_digest; }
  /// The same world as one band of light sees it, 0 red to 2 blue; it must have colour.
  World InBand(std::size_t band) const;

  /// Everything that moves, at `stamp_ns` after the start of the scene.
  Snapshot At(std::int64_t stamp_ns) const;
  /// The same by clocks, one per mover; none: all keep the scene's time.
  Snapshot At(std::int64_t stamp_ns, std::span<const ActorClock> clocks) const;
  /// The world of a snapshot a little earlier or later, each actor's clock at its rate.
  Snapshot Near(const Snapshot& snapshot, std::int64_t offset_ns) const;
  /// The velocities that Near has for each of the offsets, to the bit, without the rest of it.
  std::vector<MoverVelocities> VelocitiesNear(const Snapshot& snapshot,
                                              std::span<const std::int64_t> offsets_ns) const;
  /// Where the scene's route puts the rig at that time: T_world_rig.
  Eigen::Isometry3d PlannedRigPose(std::int64_t stamp_ns) const;

 private:
  WorldParts parts_;
};

}  // namespace aisle::sim
