#include "slam/dynamic/robust/motion_ended.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

namespace aisle::slam::dynamic {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double kShare = 0.5, kMost = 2.5, kNoise = 3;  // the last in deviations

struct Outcome {
  float left, ended;
};

/// Of one pixel, of which a longer gap found `found`.
Outcome Judge(const Matrix2d& G, const Vector2d& latest, const Vector2d& per_step, float found,
              double variance = 0.01, int steps = 1) {
  const auto one = [](double value) { return cv::Mat1f(1, 1, static_cast<float>(value)); };
  const auto two = [](const Vector2d& v) {
    return cv::Mat2f(1, 1, cv::Vec2f(static_cast<float>(v.x()), static_cast<float>(v.y())));
  };
  const EndedMotion less =
      TakeOffEndedMotion({two(latest), one(variance)}, steps,
                         {one(G(0, 0)), one(G(0, 1)), one(G(1, 1))}, two(per_step), one(found),
                         {.most = kMost, .least_speed_share = kShare, .mover_noise = kNoise});
  return {less.log_odds(0, 0), less.taken(0, 0)};
}
float Left(const Matrix2d& G, const Vector2d& latest, const Vector2d& per_step, float found) {
  return Judge(G, latest, per_step, found).left;
}

Matrix2d Corner() {
  Matrix2d G;
  G << 40, 12, 12, 90;
  return G;
}

TEST(TakeOffEndedMotion, TakesOffTheRatioOfTwoNormalDensities) {
  const double variance = 0.01;
  const Vector2d latest(0.02, 0.03), per_step(0.9, -0.6);
  const Matrix2d error = kNoise * kNoise * variance * Matrix2d::Identity();
  const Matrix2d S = (Corner().inverse() + error).inverse();
  const Vector2d off = latest - kShare * per_step;
  const double against = (off.dot(S * off) - latest.dot(S * latest)) / 2;
  ASSERT_GT(against, 0);
  ASSERT_LT(against, kMost);
  const Outcome outcome = Judge(Corner(), latest, per_step, 2.4F, variance);
  EXPECT_NEAR(outcome.left, 2.4 - against, 1e-4);
  EXPECT_NEAR(outcome.ended, against, 1e-4);
}

TEST(TakeOffEndedMotion, WhoWalkedAndStandsNowDoesNotMove) {
  const Outcome outcome = Judge(Corner(), {0.01, 0}, {2, 0.5}, 30);
  EXPECT_EQ(outcome.left, 0);
  EXPECT_EQ(outcome.ended, static_cast<float>(kMost));
}

TEST(TakeOffEndedMotion, WhoGoesOnKeepsWhatAGapMaySay) {
  EXPECT_FLOAT_EQ(Left(Corner(), {2, 0.5}, {2, 0.5}, 30), static_cast<float>(kMost));
  EXPECT_FLOAT_EQ(Left(Corner(), {1.2, 0.3}, {2, 0.5}, 1.5F), 1.5F);  // slower, but on his way
}

TEST(TakeOffEndedMotion, WhatIsTooSlowForOneStepToTellKeepsAlmostAll) {
  EXPECT_NEAR(Left(Corner(), {0, 0}, {0.04, 0.02}, 2), 2, 0.02);
}

TEST(TakeOffEndedMotion, OverManyStepsTheSlowerIsTold) {
  const Vector2d per_step(0.04, 0.02);
  EXPECT_EQ(Judge(Corner(), {0, 0}, per_step, 2, 0.01, 60).left, 0);
  EXPECT_FLOAT_EQ(Judge(Corner(), 60 * per_step, per_step, 2, 0.01, 60).left, 2);
  // Who has set out in the midst of them goes on.
  EXPECT_FLOAT_EQ(Judge(Corner(), 25 * per_step, per_step, 2, 0.01, 60).left, 2);
}

TEST(TakeOffEndedMotion, WithoutTextureOrMotionNothingChanges) {
  EXPECT_FLOAT_EQ(Left(Matrix2d::Zero(), {0, 0}, {2, 0.5}, 2), 2);
  EXPECT_FLOAT_EQ(Left(Corner(), {0, 0}, {2, 0.5}, -1.5F), -1.5F);
  EXPECT_FLOAT_EQ(Judge(Corner(), {0, 0}, {2, 0.5}, -1.5F).ended, 0);
}

TEST(TakeOffEndedMotion, WhatSaysNothingTakesNothingOff) {
  // Along an edge the information is singular, and rounding is all that there is of its
  // determinant; such a variance, squared, makes much of it.
  for (const Vector2d& edge : {Vector2d(10, 10), {9.49, 4.22}, {15.83, 8.79}, {3, 0}, {61, -22}}) {
    for (const Vector2d& per_step : {Vector2d(2, 0.5), {-0.3, 4}, {0, 0.01}}) {
      const Outcome outcome = Judge(edge * edge.transpose(), {0.1, -0.2}, per_step, 2, 1e6, 15);
      EXPECT_NEAR(outcome.left, 2, 1e-3) << edge.transpose();
      EXPECT_NEAR(outcome.ended, 0, 1e-3) << edge.transpose();
    }
  }
}

}  // namespace
}  // namespace aisle::slam::dynamic
