#pragma once

#include <functional>

#include "simulator/scene/dice.h"
#include "simulator/scene/scene.h"
#include "simulator/world/assets.h"
#include "simulator/world/palette.h"

namespace aisle::sim {

/// Where an actor holds things, world: the hands of a person, the forks of a truck. Pure.
using Grip = std::function<Eigen::Isometry3d(double time_s)>;

/// What is asked of a mover's state.
enum class MoverParts {
  kAll,
  kVelocities,  ///< its vertices', to the same bits; the rest is left as it is cheapest
};

/// Where everything of a mover is at a time. Pure; it leaves the instance index to the caller.
using MoverMotion = std::function<MoverState(double time_s, MoverParts parts)>;

/// An actor as the world needs it: its topology and how it moves.
struct Actor {
  TriangleMesh mesh;  ///< materials are the world's
  MoverMotion motion;
  Grip grip = {};  ///< none: it cannot hold anything

  MoverState At(double time_s) const { return motion(time_s, MoverParts::kAll); }
};

/// Adds the materials and textures of models to a world, each model once.
class Wardrobe {
 public:
  /// A model's first material and texture in the world.
  struct Worn {
    std::shared_ptr<const Model> model;
    std::size_t first_material = 0, first_texture = 0;
  };

  explicit Wardrobe(WorldParts* parts) : parts_(parts) {}
  const std::vector<Worn>& worn() const { return worn_; }
  /// The model's mesh with the world's material indices.
  TriangleMesh Wear(const std::shared_ptr<const Model>& model);

 private:
  WorldParts* parts_;
  std::map<const Model*, std::uint16_t> first_material_;
  std::vector<Worn> worn_;
};

/// A walking person. One whose steps play walk_carry has a box in the arms, from first to last,
/// unless it `shares_load`: what it carries then is somebody else's too.
/// Throws RouteError, or std::runtime_error when the model lacks a clip.
Actor MakePerson(const PersonSpec& person, AssetLibrary* assets, const Palette& palette, Dice dice,
                 Wardrobe* wardrobe, bool shares_load = false);

/// A vehicle with rolling and steered wheels and a mast, perhaps with a load. Its origin runs
/// `ahead_m` before the route, as that of a truck does which is pushed.
Actor MakeVehicle(const VehicleSpec& vehicle, AssetLibrary* assets, const Palette& palette,
                  Dice dice, Wardrobe* wardrobe, double ahead_m = 0);

/// How far a vehicle's forks are up where its mast has not lifted them, of what its model lifts.
double ForksAtRest_m(const VehicleSpec& vehicle);

/// How a skinned body moves: its joints (bind position -> body) in a frame that goes along with it,
/// and where that frame is. Pure.
struct BodyMotion {
  std::function<std::vector<Eigen::Affine3f>(double time_s)> joints;
  std::function<Eigen::Isometry3d(double time_s)> T_world_body;
};

/// State of a skinned model, every vertex with its own velocity. That is differenced in the body's
/// frame, where single precision is enough, and the frame's own motion is added: a body moves the
/// same wherever in the world it is. The object's pose and velocity are left to the caller.
MoverState SkinState(const Model& model, const BodyMotion& motion, double time_s, MoverParts parts);

/// Gives a mover its object's pose and velocity: where the route has it, and besides the speed
/// along the heading, whatever its origin moves to the left.
void PlaceObject(const RouteState& now, double leftwards_mps, MoverState* state);

/// Pose of an object's frame on the floor: x ahead, z up.
Eigen::Isometry3d ObjectPose(const RouteState& state);

}  // namespace aisle::sim
