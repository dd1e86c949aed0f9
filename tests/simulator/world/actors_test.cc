#include "simulator/world/actors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "simulator/mesh/import.h"
#include "simulator/scene/footprint.h"
#include "simulator/world/build.h"

namespace aisle::sim {
namespace {

using std::numbers::pi;

const std::string kAssets = std::string(AISLE_SOURCE_DIR) + "/assets";

PersonSpec PersonWalking(const std::string& model, double speed_mps, double length_m) {
  PersonSpec person;
  person.name = "walker";
  person.model = model;
  person.route.limits.turns_on_the_spot = true;
  person.route.limits.turn_rate_rad_s = 110 * pi / 180;
  person.route.plan.steps.resize(1);
  person.route.plan.steps[0].go = {{length_m, 0}};
  person.route.plan.steps[0].speed_mps = speed_mps;
  return person;
}

Actor Make(const PersonSpec& person) {
  AssetLibrary assets(kAssets);
  WorldParts parts;
  Wardrobe wardrobe(&parts);
  return MakePerson(person, &assets, {}, Dice(1, {}), &wardrobe);
}

std::vector<std::string> PeopleModels() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(kAssets + "/people")) {
    if (entry.path().extension() == ".glb") names.push_back(entry.path().stem().string());
  }
  std::ranges::sort(names);
  return names;
}

/// How far the lowest vertices of a foot move while they stay on the floor, and how deep the
/// deepest vertex sinks.
struct FootWork {
  double slip_m = 0;
  double sink_m = 0;
};

/// A vertex that is within 6 mm of the floor at both ends of a time step is standing; the longest
/// sideways way such a vertex collects in one stance is the slip.
FootWork WatchFeet(const Actor& actor, double from_s, double to_s) {
  constexpr float kContact_m = 0.006f;
  constexpr double kStep_s = 0.02;
  FootWork result;
  MoverState before = actor.At(from_s);
  std::vector<Eigen::Vector2f> touched(before.positions.size());
  std::vector<bool> standing(before.positions.size(), false);
  for (double t = from_s; t < to_s; t += kStep_s) {
    const MoverState now = actor.At(t);
    for (std::size_t i = 0; i < now.positions.size(); ++i) {
      const Eigen::Vector3f& p = now.positions[i];
      result.sink_m = std::max(result.sink_m, -static_cast<double>(p.z()));
      if (p.z() > kContact_m) {
        standing[i] = false;
      } else if (!standing[i]) {
        standing[i] = true;
        touched[i] = p.head<2>();
      } else {
        result.slip_m =
            std::max(result.slip_m, static_cast<double>((p.head<2>() - touched[i]).norm()));
      }
    }
  }
  return result;
}

void ExpectFeetStay(const std::string& model, double speed) {
  const FootWork feet = WatchFeet(Make(PersonWalking(model, speed, 30)), 4, 7);
  EXPECT_LE(feet.slip_m, 0.02) << model << " at " << speed << " m/s";
  EXPECT_LE(feet.sink_m, 0.01) << model << " at " << speed << " m/s";
}

void ExpectNoJumps(const Actor& actor, double until_s) {
  MoverState before = actor.At(0);
  constexpr double kStep_s = 0.01;
  constexpr float kFastestLimb_mps = 9;
  for (double t = kStep_s; t < until_s; t += kStep_s) {
    const MoverState now = actor.At(t);
    float jump = 0;
    for (std::size_t i = 0; i < now.positions.size(); i += 17) {
      jump = std::max(jump, (now.positions[i] - before.positions[i]).norm());
    }
    ASSERT_LT(jump, kFastestLimb_mps * kStep_s) << "at " << t;
    before = now;
  }
}

TEST(Person, FeetStayWhereTheyStandAndAboveTheFloorAtEverySpeed) {
  for (const double speed : {0.15, 0.3, 0.6, 0.9, 1.25, 1.6, 2.0}) {
    ExpectFeetStay(PeopleModels()[0], speed);
  }
}

TEST(Person, EverybodysFeetStay) {
  for (const std::string& model : PeopleModels()) {
    ExpectFeetStay(model, 0.4);
    ExpectFeetStay(model, 1.1);
  }
}

RouteStep Going(const std::vector<Eigen::Vector2d>& points, double speed_mps) {
  RouteStep step;
  step.go = points;
  step.speed_mps = speed_mps;
  step.corner_radius_m = 0.6;
  return step;
}

RouteStep TurningTo(double heading_rad) {
  RouteStep step;
  step.turn_to_rad = heading_rad;
  return step;
}

/// Starts, curves both ways, stops, turns on the spot, goes back and starts again.
PersonSpec PersonWandering(const std::string& model) {
  PersonSpec person = PersonWalking(model, 1.1, 2);
  RouteStep wait, back = Going({{4, 1}}, 0.7), corner = Going({{6, 2.6}, {6, 1}}, 1.8);
  wait.wait_s = 0.7;
  back.reverse = true;
  corner.corner_radius_m = 0;
  person.route.plan.steps = {
      Going({{2, 0}, {2, 2}, {4, 2}}, 1.1), wait,  TurningTo(pi / 2), TurningTo(-pi / 4), back,
      Going({{3, 2}, {4.5, 2.6}}, 1.4),     corner};
  return person;
}

TEST(Person, FeetStayInCurvesWhenStartingStoppingTurningAndGoingBack) {
  for (const std::string& model : PeopleModels()) {
    const FootWork feet = WatchFeet(Make(PersonWandering(model)), 0, 18);
    EXPECT_LE(feet.slip_m, 0.02) << model;
    EXPECT_LE(feet.sink_m, 0.01) << model;
  }
}

std::vector<std::string> ClipsOf(const std::string& model) {
  AssetLibrary assets(kAssets);
  std::vector<std::string> names;
  for (const auto& [name, facts] : assets.Person(model).clips) names.push_back(name);
  return names;
}

/// Every clip is shown by one of the people, each shows some.
TEST(Person, FeetStayInEveryClip) {
  const std::vector<std::string> models = PeopleModels();
  std::size_t next = 0;
  for (const std::string& clip : ClipsOf(models[0])) {
    const std::string& model = models[next++ % models.size()];
    PersonSpec person = PersonWalking(model, 0.9, 3);
    person.route.plan.steps.resize(3);
    person.route.plan.steps[1].wait_s = 3;
    person.route.plan.steps[clip.starts_with("walk") ? 0 : 1].play = clip;
    person.route.plan.steps[2].go = {{4, 1}};
    const FootWork feet = WatchFeet(Make(person), 0, 10);
    EXPECT_LE(feet.slip_m, 0.02) << model << ", " << clip;
    EXPECT_LE(feet.sink_m, 0.01) << model << ", " << clip;
  }
}

TEST(Person, WhoCarriesABoxHoldsItBetweenTheHandsAllTheTime) {
  PersonSpec person = PersonWalking(PeopleModels()[0], 1.0, 4);
  person.route.plan.steps[0].play = "walk_carry";
  const Actor actor = Make(person);
  for (double t = 0; t < 7; t += 0.5) {
    const MoverState state = actor.At(t);
    Eigen::Vector3f middle = Eigen::Vector3f::Zero();
    constexpr std::size_t kCorners = 24;  // of the box, which comes last
    for (std::size_t i = state.positions.size() - kCorners; i < state.positions.size(); ++i) {
      middle += state.positions[i] / kCorners;
    }
    const Eigen::Vector3d held = state.T_world_object.inverse() * middle.cast<double>();
    EXPECT_NEAR(held.x(), 0.38, 0.12) << t;
    EXPECT_NEAR(held.y(), 0, 0.08) << t;
    EXPECT_NEAR(held.z(), 1.15, 0.12) << t;
  }
}

TEST(Person, VelocitiesAreTheDerivativesOfPositions) {
  const Actor actor = Make(PersonWalking(PeopleModels()[0], 1.2, 30));
  const double h = 1e-3, t = 6.1;
  const MoverState before = actor.At(t - h), now = actor.At(t), after = actor.At(t + h);
  for (std::size_t i = 0; i < now.positions.size(); i += 101) {
    const Eigen::Vector3f slope =
        (after.positions[i] - before.positions[i]) / static_cast<float>(2 * h);
    EXPECT_LT((slope - now.velocities[i]).norm(), 0.06f) << i;
  }
  EXPECT_NEAR(now.velocity_mps.x(), 1.2, 1e-9);
}

TEST(Person, NeverJumps) {
  PersonSpec person = PersonWalking(PeopleModels()[0], 1.2, 3);
  person.route.plan.steps.resize(4);
  person.route.plan.steps[1].wait_s = 0.5;
  person.route.plan.steps[2].turn_to_rad = pi / 2;
  person.route.plan.steps[3].go = {{3, 2}};
  ExpectNoJumps(Make(person), 12);
}

TEST(Person, NeverJumpsWhereStepsJoin) {
  for (const char* play : {"look_back", "look_around"}) {
    PersonSpec person = PersonWalking(PeopleModels()[0], 1.1, 2.4);
    person.route.plan.steps.resize(3);
    person.route.plan.steps[1].go = {{6.8, 0}};
    person.route.plan.steps[1].play = play;
    person.route.plan.steps[2].go = {{9.4, 0}};
    ExpectNoJumps(Make(person), 10);
  }
}

/// Velocities are no coarser where coordinates are large.
TEST(Person, MovesTheSameFarFromTheOrigin) {
  const auto at = [](double x_m, double time_s) {
    PersonSpec person = PersonWalking(PeopleModels()[0], 1.2, 3);
    person.route.plan.start.x() = x_m;
    person.route.plan.steps[0].go[0].x() += x_m;
    person.route.plan.steps.resize(2);
    person.route.plan.steps[1].wait_s = 5;
    return Make(person).At(time_s);
  };
  for (const double time_s : {1.7, 7.0}) {  // walks, stands
    const MoverState near = at(0, time_s), far = at(900, time_s);
    for (std::size_t i = 0; i < near.velocities.size(); ++i) {
      ASSERT_LT((near.velocities[i] - far.velocities[i]).norm(), 1e-3f) << i << " at " << time_s;
    }
  }
}

TEST(Person, StandsAsTallAsModelledAndLooksAlongItsHeading) {
  PersonSpec person;
  person.model = PeopleModels()[0];
  person.route.plan.start = {3, 4};
  person.route.plan.heading_rad = pi / 2;
  const MoverState state = Make(person).At(0);
  Eigen::Vector3f low = state.positions[0], high = state.positions[0];
  for (const Eigen::Vector3f& p : state.positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  EXPECT_NEAR(low.z(), 0, 0.01);
  EXPECT_NEAR(high.z(), 1.8, 0.25);
  EXPECT_NEAR((low.y() + high.y()) / 2, 4, 0.2);
  EXPECT_GT(high.x() - low.x(), high.y() - low.y()) << "the shoulders lie across the heading";
  EXPECT_TRUE(state.T_world_object.linear().col(0).isApprox(Eigen::Vector3d::UnitY(), 1e-9));
}

TEST(Pushed, AreAsFarAheadAsTheirFootprintIs) {
  const AssetLibrary assets(kAssets);
  for (const std::string& name : assets.PeopleNames()) {
    const double hands_m = assets.Person(name).clips.at("walk_push").handle_ahead_m;
    for (const char* model : {"pallet_jack", "agv"}) {
      EXPECT_NEAR(AheadOfPusher(model), hands_m - assets.Vehicle(model).handle_m, 0.06)
          << name << " and " << model;
    }
  }
}

TEST(Person, AnUnknownModelOrClipIsNamed) {
  PersonSpec person = PersonWalking("nobody", 1, 2);
  EXPECT_THROW(Make(person), std::runtime_error);
  person.model = PeopleModels()[0];
  person.route.plan.steps[0].play = "fly";
  EXPECT_THROW(Make(person), std::runtime_error);
}

/// Vertices that mostly follow a node.
std::vector<std::size_t> VerticesOf(const Model& model, const std::string& node) {
  std::vector<std::size_t> vertices;
  for (std::size_t i = 0; i < model.weights.size(); ++i) {
    const ModelJoint& joint = model.joints[model.weights[i].joints[0]];
    if (joint.node == model.FindNode(node)) vertices.push_back(i);
  }
  return vertices;
}

Eigen::Vector3f MeanOf(const std::vector<Eigen::Vector3f>& points,
                       const std::vector<std::size_t>& of) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const std::size_t i : of) sum += points[i];
  return sum / static_cast<float>(of.size());
}

VehicleSpec TruckTurning(const std::string& model, double corner_radius_m = 3) {
  VehicleSpec truck;
  truck.name = "truck";
  truck.model = model;
  truck.route.limits.turns_on_the_spot = false;
  truck.route.limits.curvature_rate_per_m_s = 0.5;
  truck.route.plan.steps.resize(1);
  truck.route.plan.steps[0].go = {{corner_radius_m + 3, 0},
                                  {corner_radius_m + 3, corner_radius_m + 5}};
  truck.route.plan.steps[0].corner_radius_m = corner_radius_m;
  return truck;
}

struct Turning {
  const char* model;
  double corner_radius_m;  ///< that its wheels can steer
};

class EveryVehicle : public testing::TestWithParam<Turning> {};

TEST(Pushed, HaveTheVelocityOfTheirOrigin) {
  VehicleSpec jack;
  jack.name = "jack";
  jack.model = "pallet_jack";
  jack.route.limits.turns_on_the_spot = true;
  jack.route.plan.steps.resize(2);
  jack.route.plan.steps[0].turn_to_rad = pi / 2;
  jack.route.plan.steps[1].go = {{0, 4}, {4, 4}};
  jack.route.plan.steps[1].corner_radius_m = 1;
  AssetLibrary assets(kAssets);
  WorldParts parts;
  Wardrobe wardrobe(&parts);
  const Actor actor = MakeVehicle(jack, &assets, {}, Dice(1, {}), &wardrobe, 2.15);
  constexpr double kHalf_s = 1e-4;
  double fastest_aside_mps = 0;
  for (double t = 0.05; t < 14; t += 0.11) {
    const MoverState now = actor.At(t);
    const Eigen::Vector3d moved = (actor.At(t + kHalf_s).T_world_object.translation() -
                                   actor.At(t - kHalf_s).T_world_object.translation()) /
                                  (2 * kHalf_s);
    EXPECT_LT((now.velocity_mps - moved).norm(), 2e-3) << t;
    fastest_aside_mps =
        std::max(fastest_aside_mps, std::abs(moved.dot(now.T_world_object.linear().col(1))));
  }
  EXPECT_GT(fastest_aside_mps, 0.5);
}

TEST_P(EveryVehicle, TyresTouchTheFloorWithoutSliding) {
  AssetLibrary assets(kAssets);
  WorldParts parts;
  Wardrobe wardrobe(&parts);
  const auto [model, corner_radius_m] = GetParam();
  const Actor truck =
      MakeVehicle(TruckTurning(model, corner_radius_m), &assets, {}, Dice(1, {}), &wardrobe);
  // So low, a point of the smallest roller (4 cm) has a third of the vehicle's speed at most.
  constexpr float kTouching_m = 0.002f;
  int touching = 0;
  for (double t = 1; t < 12; t += 0.31) {
    const MoverState state = truck.At(t);
    for (std::size_t i = 0; i < state.positions.size(); ++i) {
      ASSERT_GT(state.positions[i].z(), -0.015f) << "at " << t;
      if (state.positions[i].z() > kTouching_m) continue;
      ++touching;
      // Tyres are wide: only the middle of the tread stands still in a curve.
      ASSERT_LT(state.velocities[i].norm(), 0.35f) << "at " << t;
    }
  }
  EXPECT_GT(touching, 0);
}

INSTANTIATE_TEST_SUITE_P(Models, EveryVehicle,
                         testing::Values(Turning{"forklift", 3}, Turning{"forklift_driver", 3},
                                         Turning{"reach_truck", 3}, Turning{"pallet_jack", 3},
                                         Turning{"agv", 3}, Turning{"cyclist", 3},
                                         Turning{"car_white", 7}, Turning{"car_red", 7},
                                         Turning{"car_dark", 7}, Turning{"car_silver", 7},
                                         Turning{"car_van", 7}, Turning{"bus", 11},
                                         Turning{"tow_tractor", 3}, Turning{"tow_trailer", 3},
                                         Turning{"tow_trailer_totes", 3}, Turning{"scrubber", 3},
                                         Turning{"order_picker", 3}));

TEST(Cyclist, TheFeetStayOnThePedalsAllTheWayRound) {
  AssetLibrary assets(kAssets);
  WorldParts parts;
  Wardrobe wardrobe(&parts);
  VehicleSpec ride = TruckTurning("cyclist");
  ride.route.plan.steps[0].go = {{40, 0}};
  const Actor cyclist = MakeVehicle(ride, &assets, {}, Dice(1, {}), &wardrobe);
  const std::shared_ptr<const Model> model = assets.Load("vehicles/cyclist");
  for (const std::string side : {"left", "right"}) {
    const std::vector<std::size_t> pedal = VerticesOf(*model, "pedal_" + side);
    const std::vector<std::size_t> ball = VerticesOf(*model, "toes_" + side);
    ASSERT_FALSE(pedal.empty());
    ASSERT_FALSE(ball.empty());
    double lowest = 1e9, highest = -1e9;
    for (double t = 4; t < 16; t += 0.05) {
      const MoverState state = cyclist.At(t);
      const Eigen::Vector3f at = MeanOf(state.positions, pedal);
      const Eigen::Vector3f foot = MeanOf(state.positions, ball) - at;
      lowest = std::min(lowest, double{at.z()});
      highest = std::max(highest, double{at.z()});
      // The toes' middle is ahead of the pedal's and a sole's thickness above it.
      EXPECT_NEAR(foot.z(), 0.02, 0.05) << side << " at " << t;
      EXPECT_NEAR(foot.head<2>().norm(), 0.07, 0.06) << side << " at " << t;
    }
    EXPECT_NEAR(highest - lowest, 0.34, 0.005) << "the cranks' 17 cm, twice";
  }
}

TEST(Forklift, AParkedOneIsTheSameAtEveryTime) {
  VehicleSpec truck;
  truck.model = "forklift";
  AssetLibrary assets(kAssets);
  WorldParts parts;
  Wardrobe wardrobe(&parts);
  const Actor actor = MakeVehicle(truck, &assets, {}, Dice(1, {}), &wardrobe);
  EXPECT_EQ(actor.At(0).positions, actor.At(9).positions);
  for (const Eigen::Vector3f& velocity : actor.At(9).velocities) {
    ASSERT_EQ(velocity, Eigen::Vector3f::Zero());
  }
}

TEST(Forklift, TheMastCarriesTheForksAndTheLoad) {
  VehicleSpec truck;
  truck.name = "truck";
  truck.model = "forklift";
  truck.mast = {{1, 1.5}};
  truck.load = GoodsKind::kWrapped;
  AssetLibrary assets(kAssets);
  WorldParts parts;
  Wardrobe wardrobe(&parts);
  const Actor actor = MakeVehicle(truck, &assets, {}, Dice(1, {}), &wardrobe);
  const MoverState low = actor.At(0), high = actor.At(20);
  const std::size_t last = low.positions.size() - 1;  // the load comes last
  EXPECT_NEAR(high.positions[last].z() - low.positions[last].z(), 1.5, 1e-4);
  EXPECT_GT(low.positions[last].x(), 0.5f) << "it hangs ahead of the front axle";
  EXPECT_NEAR((high.positions[0] - low.positions[0]).norm(), 0, 1.6) << "the body may be the mast";
}

}  // namespace
}  // namespace aisle::sim
