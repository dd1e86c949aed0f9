#include "simulator/motion/joint.h"

#include <gtest/gtest.h>

#include <set>

#include <cmath>
#include <numbers>

namespace aisle::sim {
namespace {

using std::numbers::pi;
using Kind = Joint::Kind;

Joint Make(Kind kind) {
  Joint joint;
  joint.kind = kind;
  joint.axis =
      kind == Kind::kChain ? Eigen::Vector3d(0.6, 0.8, 0) : Eigen::Vector3d(0.48, 0.64, 0.6);
  joint.length_m = 1.7;
  joint.decay_s = 4;
  joint.at_s = 0.5;
  if (kind == Kind::kHinge || kind == Kind::kSlider) {
    joint.start = 0.2;
    joint.moves = {{0.4, 1.3, 1.1}, {2.0, -0.4, 0.9}};
  }
  if (kind == Kind::kPendulum) joint.swing = 0.3;
  if (kind == Kind::kChain) joint.swing = 0.25;
  if (kind == Kind::kSpin) joint.speed = 2.2;
  if (kind == Kind::kBelt) joint.speed = 0.6;
  joint.run = {.from_s = 0.3, .to_s = 2.6, .ramp_s = 0.4};
  return joint;
}

/// The rate is the derivative of the pose, whatever the joint.
TEST(Joint, RatesAreTheDerivativesOfPoses) {
  constexpr double kHalf_s = 1e-5;
  for (const Kind kind : {Kind::kFixed, Kind::kHinge, Kind::kSlider, Kind::kPendulum, Kind::kSpin,
                          Kind::kBelt, Kind::kChain}) {
    const Joint joint = Make(kind);
    double fastest = 0;
    for (int k = 0; k < 400; ++k) {
      const double t = 0.0077 * k + 0.0001;
      const Placement now = JointAt(joint, 1, 3, t);
      const Eigen::Matrix4d before = JointAt(joint, 1, 3, t - kHalf_s).pose;
      const Eigen::Matrix4d after = JointAt(joint, 1, 3, t + kHalf_s).pose;
      const Eigen::Matrix4d numeric = (after - before) / (2 * kHalf_s);
      if (numeric.cwiseAbs().maxCoeff() > 100) continue;  // a belt's copy comes round just then
      EXPECT_LT((now.rate - numeric).cwiseAbs().maxCoeff(), 2e-4)
          << static_cast<int>(kind) << " at " << t;
      fastest = std::max(fastest, now.rate.cwiseAbs().maxCoeff());
      const Eigen::Matrix3d r = now.pose.topLeftCorner<3, 3>();
      EXPECT_LT((r * r.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    }
    EXPECT_EQ(fastest > 0.05, kind != Kind::kFixed) << static_cast<int>(kind);
  }
}

TEST(Joint, RestsExactlyBeforeBetweenAndAfterItsMoves) {
  for (const Kind kind :
       {Kind::kHinge, Kind::kSlider, Kind::kPendulum, Kind::kChain, Kind::kSpin, Kind::kBelt}) {
    const Joint joint = Make(kind);
    EXPECT_EQ(JointAt(joint, 0, 3, 0.1).rate.norm(), 0) << static_cast<int>(kind);
  }
  for (const Kind kind : {Kind::kHinge, Kind::kSlider}) {
    EXPECT_EQ(JointAt(Make(kind), 0, 1, 1.8).rate.norm(), 0);
    EXPECT_EQ(JointAt(Make(kind), 0, 1, 3.5).rate.norm(), 0);
  }
  for (const Kind kind : {Kind::kSpin, Kind::kBelt}) {
    EXPECT_EQ(JointAt(Make(kind), 0, 1, 3.5).rate.norm(), 0);
  }
}

TEST(Joint, GoesToWhereItsMovesSay) {
  const Joint slider = Make(Kind::kSlider);
  EXPECT_EQ(Moved(slider.moves, 0.2, 0).value, 0.2);
  EXPECT_EQ(Moved(slider.moves, 0.2, 1.8).value, 1.3);
  EXPECT_EQ(Moved(slider.moves, 0.2, 9).value, -0.4);
  // Half way at half the time, at 15/8 of the mean speed: the least jerk's own.
  EXPECT_NEAR(Moved(slider.moves, 0.2, 0.95).value, 0.75, 1e-12);
  EXPECT_NEAR(Moved(slider.moves, 0.2, 0.95).rate, 1.1 / 1.1 * 15 / 8, 1e-12);
}

TEST(Joint, ARunIsSpeedTimesTimeLessHalfARamp) {
  const RunTimes run{.from_s = 1, .to_s = 5, .ramp_s = 0.5};
  EXPECT_NEAR(Ran(run, 2, 3).value, 2 * (3 - 1 - 0.25), 1e-12);
  EXPECT_NEAR(Ran(run, 2, 100).value, 2 * (5 - 1), 1e-12) << "ramps at both ends cancel";
  EXPECT_NEAR(Ran({}, 2, 3).value, 6, 1e-12);
}

/// A pendulum's next zero of the same sign comes after 2 pi sqrt(L / g), however it fades.
TEST(Joint, APendulumKeepsItsPeriod) {
  Joint joint = Make(Kind::kPendulum);
  joint.length_m = 2.5;
  const double period = 2 * pi * std::sqrt(2.5 / 9.80665);
  for (int n = 1; n < 6; ++n) {
    EXPECT_NEAR(Swung(joint, joint.at_s + n * period).value, 0, 1e-12);
    EXPECT_GT(Swung(joint, joint.at_s + n * period).rate, 0);
  }
}

/// The chain obeys the equation of hanging chains, y_tt = g d/dz (z dy/dz), z from its free end.
TEST(Joint, AChainObeysItsEquation) {
  Joint joint = Make(Kind::kChain);
  joint.decay_s = std::numeric_limits<double>::infinity();
  const auto y = [&](double z, double t) { return ChainAt(joint, z, t).shift_m.value; };
  const double h = 1e-3;
  for (const double z : {0.2, 0.6, 1.0, 1.5}) {
    for (const double t : {0.9, 1.3, 2.2, 3.7}) {
      const double y_tt = (y(z, t + h) - 2 * y(z, t) + y(z, t - h)) / (h * h);
      const auto slope = [&](double at) { return (y(at + h, t) - y(at - h, t)) / (2 * h); };
      const double tension = ((z + h) * slope(z + h) - (z - h) * slope(z - h)) / (2 * h);
      EXPECT_NEAR(y_tt, 9.80665 * tension, 2e-4) << z << " at " << t;
      EXPECT_NEAR(ChainAt(joint, z, t).slope.value, slope(z), 1e-6);
    }
  }
  EXPECT_NEAR(y(1.7, 2.0), 0, 1e-9) << "its top is held";
}

/// Copies of a belt are evenly spaced round it, and all go at its speed, also as they come round.
TEST(Joint, ABeltKeepsItsCopiesApart) {
  Joint joint = Make(Kind::kBelt);
  joint.axis = Eigen::Vector3d::UnitX();
  joint.run = {};
  for (const double t : {0.0, 1.234, 2.8333333, 7.7}) {
    std::vector<double> places;
    for (int copy = 0; copy < 4; ++copy) {
      const Placement at = JointAt(joint, copy, 4, t);
      places.push_back(at.pose(0, 3));
      EXPECT_EQ(at.rate(0, 3), 0.6);
    }
    std::ranges::sort(places);
    for (std::size_t i = 1; i < 4; ++i) EXPECT_NEAR(places[i] - places[i - 1], 1.7 / 4, 1e-9);
    EXPECT_GE(places[0], 0);
    EXPECT_LT(places[3], 1.7);
  }
}

/// Unrolled by its rounds, a box goes on as the belt does, forwards and backwards.
TEST(Joint, ABoxHasComeRoundAsOftenAsItsPlaceFellBack) {
  Joint joint = Make(Kind::kBelt);
  joint.axis = Eigen::Vector3d::UnitX();
  joint.run = {};
  for (const double speed : {0.6, -0.6}) {
    joint.speed = speed;
    std::set<int> seen;
    for (const double t : {-3.1, 0.0, 1.234, 2.8333333, 7.7}) {
      for (int copy = 0; copy < 4; ++copy) {
        const int rounds = RoundsOf(joint, copy, 4, t);
        EXPECT_NEAR(JointAt(joint, copy, 4, t).pose(0, 3) + 1.7 * rounds,
                    speed * t + 1.7 * copy / 4, 1e-9);
        seen.insert(rounds);
      }
    }
    EXPECT_GT(seen.size(), 2u);
  }
  EXPECT_EQ(RoundsOf(Make(Kind::kSpin), 0, 1, 100), 0);
}

TEST(Joint, MovesThatOverlapAreNamed) {
  EXPECT_EQ(MovesError(Make(Kind::kHinge).moves), "");
  const std::vector<JointMove> bad = {{1, 1, 3}, {2, 0, 1}};
  EXPECT_EQ(MovesError(bad), "move 1 begins at 2 s, but the one before needs until 4 s");
}

}  // namespace
}  // namespace aisle::sim
