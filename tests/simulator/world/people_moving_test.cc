#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "simulator/scene/load.h"
#include "simulator/world/actors.h"
#include "simulator/world/build.h"
#include "simulator/world/leg_steps.h"

namespace aisle::sim {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
const std::string kSource = AISLE_SOURCE_DIR;

PersonSpec Somebody(const std::string& model) {
  PersonSpec person;
  person.name = "somebody";
  person.model = model;
  person.route.limits = {.acceleration_mps2 = 0.9,
                         .turn_rate_rad_s = 110 * kDegree,
                         .turn_acceleration_rad_s2 = 250 * kDegree,
                         .turns_on_the_spot = true};
  return person;
}

RouteStep Going(const Eigen::Vector2d& to) {
  RouteStep step;
  step.go = {to};
  return step;
}

RouteStep Waiting(double wait_s, const std::string& play) {
  RouteStep step;
  step.wait_s = wait_s;
  step.play = play;
  return step;
}

RouteStep TurningTo(double heading_deg) {
  RouteStep step;
  step.turn_to_rad = heading_deg * kDegree;
  return step;
}

Actor Make(const PersonSpec& person) {
  AssetLibrary assets(kSource + "/assets");
  WorldParts parts;
  Wardrobe wardrobe(&parts);
  return MakePerson(person, &assets, {}, Dice(1, {}), &wardrobe);
}

/// Most by which a stated velocity is off the way over a time around it.
double WidestError_mps(const Actor& actor, double time_s, double half_s) {
  const MoverState before = actor.At(time_s - half_s), now = actor.At(time_s),
                   after = actor.At(time_s + half_s);
  float widest = 0;
  for (std::size_t i = 0; i < now.positions.size(); i += 7) {
    const Eigen::Vector3f slope =
        (after.positions[i] - before.positions[i]) / static_cast<float>(2 * half_s);
    widest = std::max(widest, (slope - now.velocities[i]).norm());
  }
  return widest;
}

double Fastest_mps(const MoverState& state) {
  float fastest = 0;
  for (const Eigen::Vector3f& velocity : state.velocities) {
    fastest = std::max(fastest, velocity.norm());
  }
  return fastest;
}

/// Clips' keys are joined by lines, and people set off and stop within no time: velocities may
/// change at once, by less than this.
constexpr double kKink_mps = 1.0;

/// What is lower stands on the floor.
constexpr float kContact_m = 0.006f;

void ExpectVelocitiesAreDerivatives(const Actor& actor, double from_s, double until_s,
                                    double tick_s) {
  double sum = 0;
  int count = 0;
  for (double t = from_s; t < until_s; t += tick_s) {
    for (const double half_s : {0.002, 0.005, 0.012}) {
      const double error = WidestError_mps(actor, t, half_s);
      EXPECT_LT(error, kKink_mps) << "over " << half_s << " s at " << t;
      sum += error;
      ++count;
    }
  }
  EXPECT_LT(sum / count, 0.1);
}

TEST(Person, VelocitiesAreDerivativesWhereClipsFadeToo) {
  PersonSpec person = Somebody("worker_anton");
  person.route.plan.start_s = 0.3;
  person.route.plan.steps = {Going({1.2, 0}), Waiting(1.1, "wave"), Waiting(0.4, "look_around"),
                             Going({2.6, 0})};
  ExpectVelocitiesAreDerivatives(Make(person), 1.013, 5.5, 0.0371);
}

/// As a crowd's steps do, the acceleration and the curvature jump at tenths of a second.
PersonSpec Jolted() {
  PersonSpec person = Somebody("worker_bea");
  person.natural = true;
  PacedLeg leg;
  double speed = 0;
  for (int i = 0; i < 30; ++i) {
    const double next = i == 29 ? 0
                                : std::max(0.06, speed + (i % 3 == 2 ? -0.2
                                                          : i < 20   ? 0.2
                                                                     : -0.05));
    leg.pieces.push_back({0.1, speed, next, i % 4 < 2 ? 0.6 : -0.6});
    speed = next;
  }
  person.route.plan.paced = {leg};
  return person;
}

TEST(Person, VelocitiesAreDerivativesWhereTheAccelerationJumpsToo) {
  ExpectVelocitiesAreDerivatives(Make(Jolted()), 0.35, 2.6, 0.05);
}

/// A knee does not dart off where a leg ceases to be straight.
TEST(Person, VelocitiesAreDerivativesWhereALegIsStretchedToo) {
  PersonSpec person = Somebody("worker_bea");
  person.route.limits.acceleration_mps2 = 2;
  person.route.plan.steps = {Going({1.2, 0}), TurningTo(86), Going({1.2, 1})};
  const Actor actor = Make(person);
  for (double t = 0.02; t < 2.6; t += 0.009) EXPECT_LT(WidestError_mps(actor, t, 0.004), 0.8) << t;
}

/// Feet do not hop where the body turns by a degree: they stay flat and where they are.
TEST(Person, FeetStayOnTheFloorInASmallTurn) {
  for (const double turn_deg : {0.05, 1.0, 9.0}) {
    PersonSpec person = Somebody("worker_anton");
    person.route.plan.start_s = 0.5;
    person.route.plan.steps = {TurningTo(turn_deg), Waiting(1, "")};
    const Actor actor = Make(person);
    const MoverState before = actor.At(0.45);
    for (double t = 0.5; t < 1.2; t += 0.01) {
      const MoverState now = actor.At(t);
      for (std::size_t i = 0; i < now.positions.size(); ++i) {
        if (before.positions[i].z() > kContact_m) continue;
        ASSERT_LT((now.positions[i] - before.positions[i]).norm(), kContact_m)
            << turn_deg << ", " << t;
      }
    }
  }
}

/// Share of a time during which either foot, left and right, is on the floor.
Eigen::Vector2d StanceShares(const Actor& actor, double from_s, double until_s) {
  constexpr float kSole_m = 0.03f;
  const MoverState rest = actor.At(0);
  std::array<std::vector<std::size_t>, 2> soles;
  for (std::size_t i = 0; i < rest.positions.size(); ++i) {
    if (rest.positions[i].z() < kSole_m) soles[rest.positions[i].y() > 0 ? 0 : 1].push_back(i);
  }
  Eigen::Vector2d stands = Eigen::Vector2d::Zero();
  int count = 0;
  for (double t = from_s; t < until_s; t += 0.01, ++count) {
    const MoverState now = actor.At(t);
    for (int side : {0, 1}) {
      stands[side] +=
          std::ranges::any_of(soles[static_cast<std::size_t>(side)],
                              [&](std::size_t i) { return now.positions[i].z() < kContact_m; });
    }
  }
  return stands / count;
}

TEST(Person, ALimpShortensTheStanceOfTheRightLeg) {
  PersonSpec person = Somebody("worker_ivo");
  person.route.plan.steps = {Going({12, 0})};
  const Eigen::Vector2d even = StanceShares(Make(person), 3, 9);
  EXPECT_NEAR(even.x(), even.y(), 0.05);
  for (const double limp : {0.25, 0.5}) {
    person.limp = limp;
    const Eigen::Vector2d lame = StanceShares(Make(person), 3, 9);
    // From where it takes the weight over until it gives it back: half of the times when both
    // stand, which are as long as before, is without the weight.
    const double both = even.sum() - 1;
    EXPECT_NEAR((lame.y() - both / 2) / (lame.x() - both / 2), 1 - limp, 0.1) << limp;
    EXPECT_LT(lame.y(), even.y() - 0.2 * limp);
  }
}

TEST(RestPhase, TheRightLegStandsThroughTheHalfThatFollows) {
  AssetLibrary assets(kSource + "/assets");
  for (const std::string& name : assets.PeopleNames()) {
    const std::shared_ptr<const Model> model = assets.Load("people/" + name);
    const ClipFacts& facts = assets.Person(name).clips.at("walk_slow");
    const std::vector<WalkClip> walks = {
        {model->FindClip("walk_slow"), facts.stride_m, facts.duration_s}};
    std::vector<LegSteps> legs;
    for (const char* side : {"left", "right"}) {
      legs.emplace_back(*model, walks, model->FindClip("stand"), side);
    }
    const double spared = RestPhase(legs, walks.size()) + 0.25;
    const auto swing = [&](const LegSteps& leg) {
      const double steps = spared - leg.mid_stance();
      return leg.At({0, {1}}, steps - std::floor(steps)).swing;
    };
    EXPECT_TRUE(swing(legs[1]) == 0 || swing(legs[1]) == 1) << name;
    EXPECT_TRUE(swing(legs[0]) > 0 && swing(legs[0]) < 1) << name;
  }
}

TEST(People, AreNowhereStatedFasterThanBodiesAre) {
  constexpr double kFastestLimb_mps = 12;
  constexpr int kInstants = 100;
  for (const char* name : {"paper/scene5", "weakness/crowd", "weakness/odd_gaits",
                           "weakness/strip_curtain", "drive/narrow_crossing"}) {
    const Scene scene = LoadScene(fmt::format("{}/scenes/{}.yaml", kSource, name));
    const World world = BuildWorld(scene, kSource + "/assets", 1);
    std::set<std::string> people;
    for (const PersonSpec& person : scene.people) people.insert(person.name);
    for (int i = 0; i < kInstants; ++i) {
      const double frame = std::floor(static_cast<double>(scene.frames - 1) * i / kInstants);
      const double time_s = (frame + (i % 3) / 3.0) / scene.rate_hz;
      const Snapshot now = world.At(std::llround(time_s * 1e9));
      for (const MoverState& mover : now.movers) {
        const std::string& who = world.instances()[mover.instance].name;
        if (!people.contains(who) && !who.starts_with("crowd_")) continue;
        ASSERT_LT(Fastest_mps(mover), kFastestLimb_mps) << name << ", " << who << " at " << time_s;
      }
    }
  }
}

}  // namespace
}  // namespace aisle::sim
