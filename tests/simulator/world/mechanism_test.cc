#include "simulator/world/mechanism.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulator/scene/load.h"
#include "simulator/world/build.h"
#include "tests/simulator/world/mechanism_scene.h"

namespace aisle::sim {
namespace {

const std::string kAssets = std::string(AISLE_SOURCE_DIR) + "/assets";

World Build(const std::string& text) {
  return BuildWorld(ParseScene(kHall + text, "s.yaml"), kAssets, 1);
}

const MoverState& StateOf(const World& world, const Snapshot& snapshot, const std::string& name) {
  for (const MoverState& mover : snapshot.movers) {
    if (world.instances()[mover.instance].name == name) return mover;
  }
  throw std::runtime_error("nobody is called " + name);
}

std::int64_t Nano(double time_s) { return std::llround(1e9 * time_s); }

/// Every vertex's velocity is what its positions before and after say.
void ExpectVelocitiesOfPositions(const World& world, const std::string& name,
                                 const std::vector<double>& times, float bound_mps) {
  constexpr double kHalf_s = 0.002;
  for (const double t : times) {
    const Snapshot now = world.At(Nano(t));
    const MoverState& state = StateOf(world, now, name);
    const Snapshot earlier = world.At(Nano(t - kHalf_s)), later = world.At(Nano(t + kHalf_s));
    const MoverState& before = StateOf(world, earlier, name);
    const MoverState& after = StateOf(world, later, name);
    for (std::size_t i = 0; i < state.positions.size(); ++i) {
      const Eigen::Vector3f numeric =
          (after.positions[i] - before.positions[i]) / static_cast<float>(2 * kHalf_s);
      ASSERT_LT((numeric - state.velocities[i]).norm(), bound_mps)
          << name << ", vertex " << i << " at " << t << " s";
    }
  }
}

TEST(Mechanism, VelocitiesAreThoseOfItsVertices) {
  const World world = Build(kJoints);
  std::vector<double> times;
  for (int k = 0; k < 60; ++k) times.push_back(0.0537 + 0.1013 * k);
  ExpectVelocitiesOfPositions(world, "all", times, 4e-3f);
}

TEST(Mechanism, PartsWithoutAJointArePartOfTheBuilding) {
  const World world = Build(kJoints);
  const auto& instances = world.instances();
  const auto frame = std::ranges::find(instances, "all_frame", &Instance::name);
  const auto mover = std::ranges::find(instances, "all", &Instance::name);
  ASSERT_NE(frame, instances.end());
  ASSERT_NE(mover, instances.end());
  EXPECT_FALSE(frame->is_actor);
  EXPECT_TRUE(mover->is_actor);
  const auto index = static_cast<std::uint16_t>(frame - instances.begin());
  EXPECT_EQ(std::ranges::count(world.statics().instances, index), 12) << "a box";
}

TEST(Mechanism, StandsStillBelowItsLevel) {
  const Scene calm = WithDynamics(ParseScene(kHall + kJoints, "s.yaml"), Dynamics::kNone);
  const World world = BuildWorld(calm, kAssets, 1);
  const Snapshot first = world.At(0), later = world.At(Nano(2.5));
  EXPECT_EQ(first.movers[0].positions, later.movers[0].positions);
  for (const Eigen::Vector3f& v : later.movers[0].velocities) EXPECT_EQ(v.norm(), 0);
  const World lively = Build(kJoints);
  EXPECT_NE(lively.At(Nano(2.5)).movers[0].positions, first.movers[0].positions);
}

/// A conveyor across the hall's axes whose first part that moves is a roller that lies.
const std::string kRollers = R"(mechanisms:
  - name: conveyor
    at: [5, 1]
    heading_deg: 30
    parts:
      - {size_m: [4, 0.1, 0.6], at_m: [2, 0, 0.3]}
      - {shape: cylinder, size_m: [0.05, 0.05, 0.6], at_m: [0.2, 0, 0.7], roll_deg: 90, count: 30,
         step_m: [0.12, 0, 0], joint: {kind: spin, rate_hz: -2.8648}}
)";

TEST(Mechanism, ItsBoxDoesNotTurnWithItsRollers) {
  const World world = Build(kRollers);
  for (int k = 0; k <= 8; ++k) {
    const Snapshot now = world.At(Nano(k / 8.0 / 2.8648));
    const MoverState& rollers = StateOf(world, now, "conveyor");
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3f& position : rollers.positions) {
      box.extend(rollers.T_world_object.inverse() * position.cast<double>());
    }
    // A roller has corners: across its axis it is up to a thousandth of a metre narrower.
    EXPECT_LT((box.sizes() - Eigen::Vector3d(29 * 0.12 + 0.05, 0.6, 0.05)).norm(), 1e-3) << k;
    EXPECT_NEAR(rollers.T_world_object.translation().z(), 0.7, 1e-9);
    EXPECT_TRUE(rollers.T_world_object.linear().col(2).isApprox(Eigen::Vector3d::UnitZ()));
  }
}

const std::string kFork = R"(vehicles:
  - name: truck
    model: forklift
    start: [5, -1]
    heading_deg: 90
    start_s: 1
    mast: [{at_s: 3, height_m: 0.4}]
    steps: [{go: [[5, 0.2]], speed_mps: 0.6}, {wait_s: 2}, {go: [[5, -1.5]], speed_mps: 0.6, reverse: true}]
mechanisms:
  - name: load
    class: goods
    at: [5, 1.5]
    heading_deg: 90
    taken: [{by: truck, at_s: 3.8, until_s: 7.5}]
    parts: [{shape: pallet, goods: cartons}]
)";

/// Rests to the bit until it is taken, goes with the forks as one body, and rests where it is left.
TEST(Mechanism, AForkTakesAndLeavesIt) {
  const World world = Build(kFork);
  const auto at = [&](double t) { return StateOf(world, world.At(Nano(t)), "load"); };
  EXPECT_EQ(at(0).positions, at(3.75).positions);
  EXPECT_EQ(at(7.6).positions, at(30).positions);
  float jump = 0;
  for (const double seam : {3.8, 7.5}) {
    const MoverState before = at(seam - 1e-6), after = at(seam + 1e-6);
    for (std::size_t i = 0; i < before.positions.size(); ++i) {
      jump = std::max(jump, (before.positions[i] - after.positions[i]).norm());
    }
  }
  EXPECT_LT(jump, 1e-4f) << "it neither jumps when taken nor when left";
  const MoverState start = at(0), carried = at(6.5);
  EXPECT_GT((carried.positions[0] - start.positions[0]).norm(), 0.3f);
  for (std::size_t i = 1; i < start.positions.size(); i += 37) {
    EXPECT_NEAR((carried.positions[i] - carried.positions[0]).norm(),
                (start.positions[i] - start.positions[0]).norm(), 1e-4);
  }
  ExpectVelocitiesOfPositions(world, "load", {1.0, 5.5, 6.1, 6.9, 9.0}, 0.02f);
}

const std::string kCarried = R"(people:
  - name: rear
    model: worker_anton
    start: [3, 1]
    start_s: 0.5
    steps: [{go: [[9, 1]], speed_mps: 0.8, play: walk_carry}]
  - name: front
    model: worker_bea
    start: [6.2, 1]
    heading_deg: 180
    start_s: 0.5
    steps: [{go: [[12.2, 1]], speed_mps: 0.8, play: walk_carry, reverse: true}]
mechanisms:
  - {name: crate, class: goods, front_by: front, rear_by: rear, parts: [{paint: wood, size_m: [2.8, 0.4, 0.28]}]}
)";

TEST(Mechanism, TwoPeopleCarryItBetweenThem) {
  const World world = Build(kCarried);
  for (const double t : {0.2, 2.0, 4.1, 6.3, 15.0}) {
    const Snapshot now = world.At(Nano(t));
    const MoverState& crate = StateOf(world, now, "crate");
    const Eigen::Vector3d rear = StateOf(world, now, "rear").T_world_object.translation();
    const Eigen::Vector3d front = StateOf(world, now, "front").T_world_object.translation();
    const Eigen::Vector3d middle = crate.T_world_object.translation();
    EXPECT_NEAR(middle.x(), (rear.x() + front.x()) / 2, 0.1) << t;
    EXPECT_NEAR(middle.y(), 1, 0.1);
    EXPECT_NEAR(middle.z(), 1.1, 0.15) << "hands are at the height of the elbows";
    EXPECT_GT((crate.T_world_object.linear().col(0)).dot(Eigen::Vector3d::UnitX()), 0.98);
  }
  ExpectVelocitiesOfPositions(world, "crate", {1.9, 3.3, 5.2}, 0.05f);
  const Scene calm = WithDynamics(ParseScene(kHall + kCarried, "s.yaml"), Dynamics::kNone);
  EXPECT_TRUE(BuildWorld(calm, kAssets, 1).mover_meshes().empty()) << "it stays away with them";
}

}  // namespace
}  // namespace aisle::sim
