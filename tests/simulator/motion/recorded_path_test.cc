#include "simulator/motion/recorded_path.h"

#include <gtest/gtest.h>

namespace aisle::sim {
namespace {

constexpr std::int64_t kStepNs = 50'000'000;

/// A curve with a closed form: a screw that speeds up.
Eigen::Isometry3d Screw(double t) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = (Eigen::AngleAxisd(0.8 * t + 0.1 * t * t, Eigen::Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(0.3 * std::sin(t), Eigen::Vector3d::UnitX()))
                      .toRotationMatrix();
  pose.translation() << std::cos(t), std::sin(t), 0.2 * t * t;
  return pose;
}

RecordedPath Path(int poses) {
  std::vector<TimedPose> knots;
  for (int i = 0; i < poses; ++i) knots.push_back({7 + i * kStepNs, Screw(i * 0.05)});
  return RecordedPath(knots);
}

double Angle(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
}

TEST(RecordedPath, GoesThroughItsPosesToTheBit) {
  const RecordedPath path = Path(40);
  for (int i = 0; i < 40; ++i) {
    EXPECT_EQ(path.At(7 + i * kStepNs).matrix(), Screw(i * 0.05).matrix());
  }
}

TEST(RecordedPath, BeyondItsEndsItGoesOnAsItCameThere) {
  // A screw of constant velocity and turn rate is one and the same curve inside and outside.
  const auto even = [](double t) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = Eigen::AngleAxisd(0.3 + 0.7 * t, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    pose.translation() << 1.2 * t, 3 - 0.4 * t, 0.1 * t;
    return pose;
  };
  std::vector<TimedPose> knots;
  for (int i = 0; i < 20; ++i) knots.push_back({i * kStepNs, even(i * 0.05)});
  const RecordedPath path(knots);
  for (double t = -0.4; t < 1.4; t += 0.013) {
    const Eigen::Isometry3d at = path.At(std::llround(t * 1e9));
    EXPECT_LT((at.translation() - even(t).translation()).norm(), 1e-8) << t;
    EXPECT_LT(Angle(at, even(t)), 1e-7) << t;
  }
}

TEST(RecordedPath, OfOnePoseStands) {
  const RecordedPath path({{5, Screw(1)}});
  for (const std::int64_t t : {-kStepNs, std::int64_t{5}, kStepNs}) {
    EXPECT_EQ(path.At(t).matrix(), Screw(1).matrix());
  }
}

TEST(RecordedPath, BetweenThemItIsWhereACurveWouldBe) {
  const RecordedPath path = Path(40);
  for (int i = 1; i < 38; ++i) {  // the ends know one neighbour alone
    const Eigen::Isometry3d between = path.At(7 + i * kStepNs + kStepNs / 2);
    const Eigen::Isometry3d expected = Screw((i + 0.5) * 0.05);
    EXPECT_LT((between.translation() - expected.translation()).norm(), 2e-5) << i;
    EXPECT_LT(Angle(between, expected), 2e-5) << i;
    EXPECT_TRUE((between.linear() * between.linear().transpose()).isIdentity(1e-12));
  }
}

TEST(RecordedPath, VelocityAndTurnRateDoNotJump) {
  const RecordedPath path = Path(40);
  constexpr std::int64_t kNear = 10'000;  // ns
  for (int i = 0; i < 40; ++i) {
    const std::int64_t at = 7 + i * kStepNs;
    const Eigen::Isometry3d before = path.At(at - kNear), here = path.At(at),
                            after = path.At(at + kNear);
    const Eigen::Vector3d jump =
        (after.translation() - here.translation()) - (here.translation() - before.translation());
    EXPECT_LT(jump.norm() / (kNear * 1e-9), 1e-3) << i;  // m/s
    EXPECT_LT(Angle(Eigen::Isometry3d(before.linear().transpose() * here.linear()),
                    Eigen::Isometry3d(here.linear().transpose() * after.linear())) /
                  (kNear * 1e-9),
              5e-3)
        << i;
  }
}

/// A body that tumbles: its turn rate changes from pose to pose in size and axis.
TEST(RecordedPath, TheTurnRateOfATumblingBodyDoesNotJump) {
  const auto tumbling = [](double t) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = (Eigen::AngleAxisd(3 * std::sin(1.7 * t), Eigen::Vector3d::UnitX()) *
                     Eigen::AngleAxisd(2.2 * t, Eigen::Vector3d::UnitY()) *
                     Eigen::AngleAxisd(2 * std::cos(2.9 * t), Eigen::Vector3d::UnitZ()))
                        .toRotationMatrix();
    return pose;
  };
  std::vector<TimedPose> knots;
  for (int i = 0; i < 40; ++i) knots.push_back({i * kStepNs, tumbling(i * 0.05)});
  const RecordedPath path(knots);
  constexpr std::int64_t kNear = 10'000;  // ns
  const auto rate = [&](std::int64_t from, std::int64_t to) {
    const Eigen::AngleAxisd turn(path.At(from).linear().transpose() * path.At(to).linear());
    return Eigen::Vector3d(turn.angle() * turn.axis() / (kNear * 1e-9));
  };
  double fastest_rad_s = 0;
  for (int i = 1; i < 39; ++i) {
    const std::int64_t at = i * kStepNs;
    EXPECT_LT((rate(at, at + kNear) - rate(at - kNear, at)).norm(), 0.02) << i;
    fastest_rad_s = std::max(fastest_rad_s, rate(at, at + kNear).norm());
  }
  EXPECT_GT(fastest_rad_s, 5);
}

TEST(RecordedPath, RefusesTimesThatFall) {
  for (const std::vector<std::int64_t>& times : std::vector<std::vector<std::int64_t>>{
           {5, 5}, {5, 4}, {0, 1, 1, 2}, {0, 2, 1, 3}, {0, 1, 2, 2}, {0, 0, 1, 2}}) {
    std::vector<TimedPose> poses;
    for (const std::int64_t time_ns : times) poses.push_back({time_ns, Screw(0)});
    EXPECT_THROW(RecordedPath{poses}, std::invalid_argument) << testing::PrintToString(times);
  }
  EXPECT_THROW(RecordedPath(std::vector<TimedPose>{}), std::invalid_argument);
}

}  // namespace
}  // namespace aisle::sim
