#include "simulator/motion/crowd.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "simulator/motion/crowd_forces.h"

namespace aisle::sim {
namespace {

CrowdPlan Aisle() {
  CrowdPlan plan;
  plan.people = 9;
  plan.from = {2, -2}, plan.to = {14, 2};
  plan.duration_s = 20;
  plan.limits = {.acceleration_mps2 = 0.9,
                 .turn_rate_rad_s = 1.9,
                 .turn_acceleration_rad_s2 = 4.4,
                 .turns_on_the_spot = true};
  plan.blocks = {{{7, 0.8}, {0.4, 0.3}, 0.3}, {{11, -1.2}, {0.2, 0.2}, 0}};
  CrowdIntruder rig{{}, 0.45};
  for (int i = 0; i < 260; ++i) rig.places.emplace_back(-2 + 0.05 * i, 0);
  plan.intruders = {rig};
  return plan;
}

std::vector<Route> RoutesOf(const CrowdPlan& plan, std::uint64_t seed) {
  std::vector<Route> routes;
  for (const RoutePlan& one : WalkCrowd(plan, seed)) routes.emplace_back(one, plan.limits);
  return routes;
}

/// Asked ten times finer than the crowd's own clock.
TEST(Crowd, NobodyComesNearerThanTheDistanceNorIntoWhatStands) {
  const CrowdPlan plan = Aisle();
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const std::vector<Route> routes = RoutesOf(plan, seed);
    ASSERT_EQ(routes.size(), 9u);
    for (double t = 0; t <= plan.duration_s; t += 0.01) {
      for (std::size_t i = 0; i < routes.size(); ++i) {
        const Eigen::Vector2d at = routes[i].At(t).position;
        for (std::size_t k = i + 1; k < routes.size(); ++k) {
          ASSERT_GE((routes[k].At(t).position - at).norm(), plan.distance_m)
              << i << " and " << k << " at " << t << " s, seed " << seed;
        }
        for (const CrowdBlock& block : plan.blocks) {
          ASSERT_GE(DistanceTo(block, at), plan.radius_m - 0.01) << t << " s, seed " << seed;
        }
        ASSERT_GE((at - plan.from).minCoeff(), plan.radius_m - 0.01);
        ASSERT_GE((plan.to - at).minCoeff(), plan.radius_m - 0.01);
      }
    }
  }
}

TEST(Crowd, NobodyIsRunIntoByWhoDoesNotGiveWay) {
  const CrowdPlan plan = Aisle();
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    for (const Route& route : RoutesOf(plan, seed)) {
      for (double t = 0; t <= plan.duration_s; t += kCrowdStep_s) {
        ASSERT_GE((route.At(t).position - plan.intruders[0].At(t)).norm(),
                  plan.intruders[0].radius_m + plan.radius_m - 1e-6)
            << t << " s, seed " << seed;
      }
    }
  }
}

TEST(Crowd, ASeedIsTheSameToTheBitAndAnotherIsNot) {
  const CrowdPlan plan = Aisle();
  const std::vector<Route> once = RoutesOf(plan, 3), again = RoutesOf(plan, 3);
  const std::vector<Route> other = RoutesOf(plan, 4);
  bool differs = false;
  for (std::size_t i = 0; i < once.size(); ++i) {
    for (double t = 0; t <= 20; t += 0.37) {
      EXPECT_EQ(once[i].At(t).position, again[i].At(t).position);
      differs = differs || (once[i].At(t).position - other[i].At(t).position).norm() > 0.5;
    }
  }
  EXPECT_TRUE(differs);
}

/// Position, heading and speed have no jumps, the velocity is along the heading.
TEST(Crowd, WaysAreThoseOfBodies) {
  const CrowdPlan plan = Aisle();
  constexpr double kStep_s = 0.01;
  for (const Route& route : RoutesOf(plan, 2)) {
    RouteState before = route.At(0);
    for (double t = kStep_s; t <= plan.duration_s; t += kStep_s) {
      const RouteState now = route.At(t);
      const Eigen::Vector2d step = now.position - before.position;
      const Eigen::Vector2d ahead(std::cos(before.heading_rad), std::sin(before.heading_rad));
      EXPECT_NEAR(step.norm(), kStep_s * (now.speed_mps + before.speed_mps) / 2, 1e-4) << t;
      EXPECT_LT((step - step.norm() * ahead).norm(), 1e-3) << t;
      EXPECT_LT(std::abs(now.heading_rad - before.heading_rad), 0.08) << t;
      EXPECT_LT(std::abs(now.speed_mps - before.speed_mps), 0.025) << t;
      before = now;
    }
  }
}

/// They do walk, rests, turns and giving way included: a fifth of a metre a second at least.
TEST(Crowd, WalksAndDoesNotFreeze) {
  const CrowdPlan plan = Aisle();
  double way = 0;
  const std::vector<Route> routes = RoutesOf(plan, 1);
  for (const Route& route : routes) way += route.At(plan.duration_s).odometer_m;
  EXPECT_GT(way / (plan.duration_s * static_cast<double>(routes.size())), 0.2);
}

TEST(Crowd, SaysWhenThereIsNoRoom) {
  CrowdPlan plan = Aisle();
  plan.people = 60;
  plan.to = {5, 1};
  try {
    WalkCrowd(plan, 1);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()),
              "there is no room for 60 people 0.6 m apart between [2, -2] and [5, 1]: fewer "
              "people, or a larger part of the hall");
  }
}

/// The forces are minus the gradients of their potentials (equations 3 and 4), whole where the
/// other is within 100 degrees of ahead, and half where not.
TEST(CrowdForces, PushDownTheirPotentials) {
  const BodyNow other{{0.2, -0.1}, 0.7, 1.2};
  const auto potential = [&](const Eigen::Vector2d& at) {
    const Eigen::Vector2d r = at - other.position, y = 2 * other.velocity();
    const double sum = r.norm() + (r - y).norm();
    return 2.1 * std::exp(-std::sqrt(sum * sum - y.squaredNorm()) / 2 / 0.3);
  };
  const double h = 1e-6;
  for (const Eigen::Vector2d& at : {Eigen::Vector2d(1.5, 0.1), {0.3, 1.2}, {2.2, 1.6}}) {
    const Eigen::Vector2d down(
        -(potential({at.x() + h, at.y()}) - potential({at.x() - h, at.y()})) / (2 * h),
        -(potential({at.x(), at.y() + h}) - potential({at.x(), at.y() - h})) / (2 * h));
    const double comes_from_rad = std::atan2(-down.y(), -down.x());
    for (const double aside_deg : {0.0, 95.0, -95.0, 105.0, -105.0, 180.0}) {
      const BodyNow body{at, comes_from_rad + aside_deg * std::numbers::pi / 180, 1};
      const double share = std::abs(aside_deg) < 100 ? 1 : 0.5;
      EXPECT_LT((PersonForce(body, other) - share * down).norm(), 1e-6) << aside_deg;
    }
  }
}

/// Somebody who stands steps aside of a truck's way while it is still 3.6 m off, and does not mind
/// one that has passed.
TEST(CrowdForces, KeepClearOfWhereAnIntruderIsGoingToBe) {
  const BodyNow body{{0, 0}, 0, 0};
  const auto truck = [](double speed_mps) {
    CrowdIntruder intruder;
    for (int k = 0; k < 60; ++k) {
      intruder.places.emplace_back(-3.6 + speed_mps * k * kCrowdStep_s, -0.4);
    }
    return intruder;
  };
  const Eigen::Vector2d comes = IntruderForce(body, truck(2), 0);
  EXPECT_GT(comes.y(), 0.5) << "off its way, which passes on the right";
  EXPECT_LT(IntruderForce(body, truck(-2), 0).norm(), 0.01);
}

}  // namespace
}  // namespace aisle::sim
