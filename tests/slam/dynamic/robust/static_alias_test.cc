#include "slam/dynamic/robust/static_alias.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/slam/dynamic/robust/usual_tolerance.h"

namespace aisle::slam::dynamic {
namespace {

constexpr float kFound = 2.5F;
constexpr int kOwn = 12;  // the disparity that the matcher gives, half-size pixels

/// Compared by what a matcher with its usual options has searched.
AliasViews Views(const DenseFrame& now, const cv::Mat1b& then, const cv::Mat1f& variance) {
  return {now, then, variance, test::kUsualTolerance, SemiGlobalOptions().max_disparity_px};
}

/// A wall whose columns repeat after `period`, at `disparity` in the right image, and where the
/// rig's way has taken it `way` columns to the right in the earlier one.
struct Wall {
  DenseFrame now;
  cv::Mat1b then;
  cv::Mat1f variance;

  Wall(int period, int disparity, int way) {
    std::mt19937 random(7);
    std::vector<unsigned char> greys(static_cast<std::size_t>(period));
    for (auto& grey : greys) grey = static_cast<unsigned char>(60 + random() % 130);
    const auto view = [&](int shift) {
      cv::Mat1b image(40, 160);
      for (int x = 0; x < image.cols; ++x) {
        const int column = ((x + shift) % period + period) % period;
        image.col(x) = greys[static_cast<std::size_t>(column)];
      }
      return image;
    };
    now.image = view(0);
    now.right_low = now.right_high = view(disparity);
    then = view(-way);
    variance = cv::Mat1f(now.image.size(), 8.0F);
  }

  /// Of a pixel that flows by `flow` columns; each pixel of disparity makes half of one.
  float Left(cv::Point at, float flow, float per_disparity = 0.5F) const {
    const auto x = static_cast<float>(at.x), y = static_cast<float>(at.y);
    const SeenMotion seen{
        at, kOwn, {x + flow, y}, {x + kOwn * per_disparity, y}, kOwn, {per_disparity, 0}};
    return LimitByAlias(Views(now, then, variance), seen, kFound, {});
  }
};

TEST(LimitByAlias, AWallMatchedAPeriodOffIsStatic) {
  const Wall wall(8, 4, 2);  // its own disparity is 4, the matcher's 12
  EXPECT_EQ(wall.Left({80, 20}, 2), 0);
}

TEST(LimitByAlias, AndSoItIsWhereTheFlowIsAPeriodOffAsWell) {
  const Wall wall(8, 4, 2);
  EXPECT_EQ(wall.Left({80, 20}, 10), 0);
  EXPECT_EQ(wall.Left({80, 20}, -6), 0);
}

TEST(LimitByAlias, WhatDoesNotRepeatAndMovesKeepsAll) {
  const Wall mover(1000, kOwn, 2);
  EXPECT_FLOAT_EQ(mover.Left({80, 20}, 2), kFound);
}

TEST(LimitByAlias, ARepeatingPatternThatNoStaticWayExplainsKeepsAll) {
  const Wall mover(8, 4, 5);  // static at 4 + 8 k pixels it would go 2 + 4 k, never 5
  EXPECT_FLOAT_EQ(mover.Left({80, 20}, 5), kFound);
}

/// A beam that runs along the rows looks much the same at every disparity: the lamp that is
/// mirrored in it lets the fit fall evenly towards the far, and no disparity between fits better
/// than both its neighbours.
TEST(LimitByAlias, ABeamAlongTheRowsMayBeAtAnyDisparityThatFitsAsWell) {
  const cv::Point at(80, 20);
  std::mt19937 random(7);
  DenseFrame now;
  now.image.create(40, 160);
  for (int y = 0; y < now.image.rows; ++y) {
    now.image.row(y) = static_cast<unsigned char>(60 + random() % 130);
  }
  cv::Mat1b right = now.image.clone();
  for (int x = 0; x < right.cols; ++x) right.col(x) += (at.x - x) / 4;
  now.right_low = now.right_high = right;
  cv::Mat1b then(now.image.size());
  const int way = 2;  // as at disparity 4
  for (int y = 0; y < then.rows; ++y) now.image.row(std::max(y - way, 0)).copyTo(then.row(y));
  const cv::Mat1f variance(now.image.size(), 8.0F);
  const SeenMotion seen{at, kOwn, {80, 20.0F + way}, {80, 20 + 0.5F * kOwn}, kOwn, {0, 0.5F}};
  EXPECT_EQ(LimitByAlias(Views(now, then, variance), seen, kFound, {}), 0);
}

TEST(LimitByAlias, BeforeAStandingRigNoDisparityExplainsAnything) {
  const Wall wall(8, 4, 2);
  EXPECT_FLOAT_EQ(wall.Left({80, 20}, 2, 0), kFound);
}

TEST(LimitByAlias, AtTheEdgesNothingOutsideIsRead) {
  const Wall wall(8, 4, 2);
  for (const int x : {0, 1, 11, 12, 14, 20, 157, 159}) {
    for (const int y : {0, 2, 38, 39}) {
      const float left = wall.Left({x, y}, 2);
      EXPECT_GE(left, 0) << x << ", " << y;
      EXPECT_LE(left, kFound) << x << ", " << y;
    }
  }
}

}  // namespace
}  // namespace aisle::slam::dynamic
