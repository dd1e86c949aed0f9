#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "simulator/mesh/pose.h"
#include "simulator/world/actors.h"
#include "simulator/world/goods.h"
#include "simulator/world/held.h"
#include "simulator/world/shapes.h"

namespace aisle::sim {
namespace {

/// Who pushes a vehicle from a line into an arc turns its wheels over this time.
constexpr double kSteering_s = 0.8;
/// Forks above the floor when travelling, with and without a load.
constexpr double kCarriedAt_m = 0.14, kEmptyAt_m = 0.06;

// Nodes keep the axes of the glTF file, where the object's y is -z and its z is y.
const Eigen::Vector3f kNodeLeft = -Eigen::Vector3f::UnitZ();
const Eigen::Vector3f kNodeUp = Eigen::Vector3f::UnitY();

struct WheelNode {
  int node = 0;
  Wheel wheel;
};

struct LiftNode {
  int node = 0;
  double share = 0;
};

/// What turns with the cranks of a vehicle that is ridden.
struct Pedalling {
  int clip = -1;
  double clip_s = 0;
  double development_m = 5;
  int crank = -1;
  std::vector<int> pedals;

  double TurnsAt(const RouteState& state) const { return state.odometer_m / development_m; }
};

Pedalling PedallingOf(const Model& model, const RiddenFacts& facts) {
  Pedalling pedalling{
      model.FindClip(facts.clip), 0, facts.development_m, model.FindNode(facts.crank_node), {}};
  for (const std::string& name : facts.pedal_nodes) {
    pedalling.pedals.push_back(model.FindNode(name));
  }
  if (pedalling.clip < 0 || pedalling.crank < 0 || std::ranges::count(pedalling.pedals, -1) > 0) {
    throw std::runtime_error(fmt::format(
        "the model '{}' lacks the clip, crank or pedals that the manifest names", model.name));
  }
  pedalling.clip_s = model.clips[static_cast<std::size_t>(pedalling.clip)].duration_s;
  return pedalling;
}

class Driver {
 public:
  Driver(const VehicleSpec& vehicle, std::shared_ptr<const Model> model, const VehicleFacts& facts,
         double ahead_m)
      : model_(std::move(model)),
        route_(vehicle.route.plan, vehicle.route.limits),
        steers_(std::isfinite(vehicle.route.limits.curvature_rate_per_m_s)),
        ahead_m_(ahead_m),
        mast_(vehicle.mast, kMastSpeed_mps, kMastAcceleration_mps2),
        fork_rest_m_(ForksAtRest_m(vehicle)) {
    const NodeFrames rest = PoseNodes(*model_, {});
    const auto wheel_at = [&](int node, double radius) {
      const Eigen::Vector3f at = rest[static_cast<std::size_t>(node)].translation();
      return Wheel{at.x() + ahead_m_, at.y(), radius};
    };
    for (const auto& [name, radius] : facts.wheel_radius_m) {
      const int node = model_->FindNode(name);
      if (node >= 0) wheels_.push_back({node, wheel_at(node, radius)});
    }
    for (const std::string& name : facts.steer_nodes) {
      const int node = model_->FindNode(name);
      if (node >= 0) steered_.push_back({node, wheel_at(node, 0)});
    }
    if (facts.ridden) pedalling_ = PedallingOf(*model_, *facts.ridden);
    for (const auto& [name, share] : facts.lift_shares) {
      const int node = model_->FindNode(name);
      if (node >= 0) lifted_.push_back({node, share});
    }
  }

  /// The route of its origin, which of one that is pushed turns about the pusher.
  RouteState RouteAt(double time_s) const {
    RouteState state = route_.At(time_s);
    state.position +=
        ahead_m_ * Eigen::Vector2d(std::cos(state.heading_rad), std::sin(state.heading_rad));
    return state;
  }

  /// Where a node is in the world.
  Eigen::Isometry3d NodeAt(int node, double time_s) const {
    const RouteState state = RouteAt(time_s);
    const NodeFrames frames = PoseNodes(*model_, RiderAt(state), MovesAt(state, time_s));
    return ObjectPose(state) *
           Eigen::Isometry3d(frames[static_cast<std::size_t>(node)].matrix().cast<double>());
  }

  MoverState At(double time_s, MoverParts parts) const {
    MoverState moved = SkinState(
        *model_,
        {[&](double t) {
           const RouteState state = RouteAt(t);
           return JointMatrices(*model_, PoseNodes(*model_, RiderAt(state), MovesAt(state, t)));
         },
         [&](double t) { return ObjectPose(RouteAt(t)); }},
        time_s, parts);
    const RouteState state = RouteAt(time_s);
    PlaceObject(state, ahead_m_ * state.yaw_rate_rad_s, &moved);
    return moved;
  }

 private:
  /// The rider's legs at this turn of the cranks.
  std::vector<PoseLayer> RiderAt(const RouteState& state) const {
    if (!pedalling_) return {};
    const double turns = pedalling_->TurnsAt(state);
    return {{pedalling_->clip, (turns - std::floor(turns)) * pedalling_->clip_s, 1, -1}};
  }

  std::vector<NodeMove> MovesAt(const RouteState& state, double time_s) const {
    std::vector<NodeMove> moves;
    const auto turn = [&](int node, const Eigen::Vector3f& axis, double angle) {
      moves.push_back({node, Eigen::Affine3f(Eigen::AngleAxisf(static_cast<float>(angle), axis))});
    };
    const double heading_at_start = route_.At(0).heading_rad;
    for (const WheelNode& one : wheels_) {
      turn(one.node, kNodeLeft, RolledAngle(one.wheel, state, heading_at_start));
    }
    if (pedalling_) {
      const double angle = 2 * std::numbers::pi * pedalling_->TurnsAt(state);
      turn(pedalling_->crank, kNodeLeft, angle);
      for (const int pedal : pedalling_->pedals) turn(pedal, kNodeLeft, -angle);
    }
    const double curvature =
        steers_ ? state.curvature_per_m : SmoothCurvature(route_, time_s, kSteering_s);
    for (const WheelNode& one : steered_) {
      turn(one.node, kNodeUp, SteeringAngle(one.wheel, curvature));
    }
    const double lift = fork_rest_m_ + mast_.HeightAt(time_s);
    for (const LiftNode& one : lifted_) {
      const Eigen::Vector3f up = static_cast<float>(lift * one.share) * kNodeUp;
      moves.push_back({one.node, Eigen::Affine3f(Eigen::Translation3f(up))});
    }
    return moves;
  }

  std::shared_ptr<const Model> model_;
  Route route_;
  bool steers_;  ///< its way's curvature is continuous
  double ahead_m_ = 0;
  MastLift mast_;
  double fork_rest_m_;
  std::vector<WheelNode> wheels_, steered_;
  std::optional<Pedalling> pedalling_;
  std::vector<LiftNode> lifted_;
};

/// A loaded pallet on the forks, in the vehicle's frame.
TriangleMesh LoadOnForks(const VehicleSpec& vehicle, const VehicleFacts& facts,
                         const Palette& palette, Dice dice) {
  constexpr float kUnderDeck_m = 0.122f;  // where forks lift a pallet
  TriangleMesh mesh;
  const auto x = static_cast<float>(facts.fork_heel_x_m) + kPalletLength_m / 2 + 0.02f;
  const float z = static_cast<float>(facts.fork_top_m) - kUnderDeck_m;
  AddLoadedPallet(&mesh, palette, At(x, 0, z), 1.0f, vehicle.load, dice);
  return mesh;
}

}  // namespace

double ForksAtRest_m(const VehicleSpec& vehicle) {
  return vehicle.load == GoodsKind::kNothing ? kEmptyAt_m : kCarriedAt_m;
}

Actor MakeVehicle(const VehicleSpec& vehicle, AssetLibrary* assets, const Palette& palette,
                  Dice dice, Wardrobe* wardrobe, double ahead_m) {
  const VehicleFacts& facts = assets->Vehicle(vehicle.model);
  std::shared_ptr<const Model> model = assets->Load("vehicles/" + vehicle.model);
  TriangleMesh mesh = wardrobe->Wear(model);
  const int forks = facts.fork_node.empty() ? -1 : model->FindNode(facts.fork_node);
  if (vehicle.load != GoodsKind::kNothing && forks >= 0) {
    const TriangleMesh load = LoadOnForks(vehicle, facts, palette, dice);
    model = std::make_shared<const Model>(Carrying(*model, load, forks, PoseNodes(*model, {})));
    AddMesh(&mesh, Eigen::Isometry3f::Identity(), load);
  }
  const auto driver = std::make_shared<const Driver>(vehicle, model, facts, ahead_m);
  Grip grip;
  if (forks >= 0) grip = [driver, forks](double time_s) { return driver->NodeAt(forks, time_s); };
  if (vehicle.route.plan.steps.empty() && vehicle.mast.empty()) {  // parked for good
    return {std::move(mesh),
            [state = driver->At(0, MoverParts::kAll)](double, MoverParts) { return state; }, grip};
  }
  return {std::move(mesh),
          [driver](double time_s, MoverParts parts) { return driver->At(time_s, parts); }, grip};
}

}  // namespace aisle::sim
