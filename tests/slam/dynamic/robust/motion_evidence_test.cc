#include "slam/dynamic/robust/motion_evidence.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "slam/dynamic/common/stereo_pair.h"
#include "slam/dynamic/robust/earlier_disparity.h"
#include "slam/dynamic/robust/label_memory.h"
#include "slam/dynamic/robust/residual_flow.h"
#include "tests/slam/dynamic/robust/usual_tolerance.h"
#include "tests/slam/dynamic/synthetic_stereo.h"

namespace aisle::slam::dynamic {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix2f;
using Eigen::Vector2f;
using Eigen::Vector3d;
using test::kUsualTolerance;

/// The logarithm of a normal density in two dimensions.
double LogNormal(const Eigen::Matrix2d& covariance, const Eigen::Vector2d& r) {
  return -0.5 * r.dot(covariance.inverse() * r) -
         std::log(2 * std::numbers::pi * std::sqrt(covariance.determinant()));
}

TEST(DisplacementLogOdds, IsTheRatioOfTwoNormalDensities) {
  Matrix2f G;
  G << 40, 12, 12, 9;
  for (const Vector2f& r : {Vector2f(0, 0), Vector2f(0.4F, -0.2F), Vector2f(2, 3)}) {
    const Eigen::Matrix2d measured = G.cast<double>().inverse();
    const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
    const double expected = LogNormal(measured + 1.51 * one, r.cast<double>()) -
                            LogNormal(measured + 0.01 * one, r.cast<double>());
    EXPECT_NEAR(DisplacementLogOdds(G, r, 0.01F, 1.5F), expected, 1e-3 * (1 + std::abs(expected)));
  }
}

TEST(DisplacementLogOdds, WithoutTextureNothingIsKnown) {
  EXPECT_EQ(DisplacementLogOdds(Matrix2f::Zero(), {5, 5}, 0.01F, 1), 0);
}

TEST(DisplacementLogOdds, AlongAnEdgeNothingIsKnownAndAcrossItMuch) {
  Matrix2f edge = Matrix2f::Zero();
  edge(0, 0) = 100;  // grey changes along x alone
  EXPECT_LT(DisplacementLogOdds(edge, {0, 4}, 0.01F, 1), 0);
  EXPECT_GT(DisplacementLogOdds(edge, {4, 0}, 0.01F, 1), 10);
}

TEST(DisplacementLogOdds, OfEdgesIsAsExactOverLongGaps) {
  // Singular information, and variances of movers that are near or seen again after long.
  for (int degrees = 0; degrees < 180; degrees += 7) {
    const double angle = degrees * std::numbers::pi / 180;
    const Eigen::Vector2d across(std::cos(angle), std::sin(angle));
    for (const double strength : {100.0, 2000.0, 8000.0}) {
      for (const double mover : {1.0, 400.0, 15625.0, 60000.0}) {
        const Eigen::Vector2d r(0.2, -0.1);
        // Only across the edge anything is known: the ratio of two densities in one dimension.
        const auto log_normal = [&](double variance) {
          const double total = 1 / strength + variance, off = r.dot(across);
          return -0.5 * (off * off / total + std::log(total));
        };
        const double expected = log_normal(0.02 + mover) - log_normal(0.02);
        const Matrix2f G = (strength * across * across.transpose()).cast<float>();
        EXPECT_NEAR(DisplacementLogOdds(G, r.cast<float>(), 0.02F, static_cast<float>(mover)),
                    expected, 5e-3 * (1 + std::abs(expected)))
            << degrees << " degrees, strength " << strength << ", mover " << mover;
      }
    }
  }
}

/// A lamp's reflection: light that is added to both images of a pair.
struct Glare {
  cv::Point2d at = {400, 200};     ///< full pixels of the left image
  double deviation_px = 12;        ///< its size
  double grey = 0;                 ///< levels at its centre
  cv::Point2d per_frame = {1, 5};  ///< the way it goes from frame to frame
};

void AddGlare(const Glare& glare, cv::Point2d at, cv::Mat1b& image) {
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const cv::Point2d off = cv::Point2d(x, y) - at;
      const double light =
          glare.grey * std::exp(-off.dot(off) / 2 / std::pow(glare.deviation_px, 2));
      image(y, x) = cv::saturate_cast<unsigned char>(image(y, x) + light);
    }
  }
}

/// On the surface that is seen there.
void AddGlare(const Glare& glare, cv::Point2d at, test::SyntheticView& view) {
  AddGlare(glare, at, view.left);
  AddGlare(glare, at - cv::Point2d(view.disparity(cv::Point(at)), 0), view.right);
}

/// With the usual noise, after a matcher with its usual options.
Comparison Compared(const DenseFrame& now, const DenseFrame& then, const cv::Mat2f& flow,
                    const Isometry3d& T_then_now, double seconds) {
  const RobustOptions options;
  return {.now = now,
          .then = then,
          .flow = flow,
          .tolerance = kUsualTolerance,
          .T_then_now = T_then_now,
          .seconds = seconds,
          .flow_noise = 0.12,
          .disparities = options.disparity.max_disparity_px,
          .sure = options.region.core_log_odds};
}

/// Two frames of the hall, what the second makes of the first, and what moves.
struct Pair {
  DenseFrame then, now;
  Texture texture;
  std::vector<cv::Point> points;
  cv::Mat2f expected, flow;
  cv::Mat1f log_odds;
  cv::Mat1b moving;  // half size

  Pair(const std::vector<test::Panel>& movers, const Vector3d& way, double seconds,
       const Glare& glare = {}, const SurfaceOptions& surface = {}) {
    auto panels = test::StaticHall();
    panels.insert(panels.end(), movers.begin(), movers.end());
    Isometry3d T_world_now = Isometry3d::Identity();
    T_world_now.translation() = way;
    auto before = test::Render(panels, {}, Isometry3d::Identity(), 0, 2.0);
    auto after = test::Render(panels, {}, T_world_now, seconds, 2.0);
    AddGlare(glare, glare.at, before);
    AddGlare(glare, glare.at + glare.per_frame, after);
    RobustOptions options;
    options.surface = surface;
    then = MakeDenseFrame(HalfImage(before.left), HalfImage(before.right), options.disparity);
    now = MakeDenseFrame(HalfImage(after.left), HalfImage(after.right), options.disparity);
    texture = MeasureTexture(now.image, options.surface);
    points = WellHeld(texture, now.disparity, 12);
    const StereoCamera half = HalfCamera({});
    expected = WhereStatic(now.filled, T_world_now, half).place;
    flow = FollowBack(now.image, MakeFlowPyramid(now.image, options.flow), then.image, expected,
                      options.flow);
    Comparison comparison = Compared(now, then, flow, T_world_now, seconds);
    comparison.monocular = true;
    log_odds =
        CompareMotion(comparison, texture, LookAround(now, options.surface, options.evidence), half,
                      options.evidence)
            .log_odds;
    moving = cv::Mat1b(now.image.size());
    for (int y = 0; y < moving.rows; ++y) {
      for (int x = 0; x < moving.cols; ++x) moving(y, x) = after.moving(2 * y, 2 * x);
    }
  }

  /// Share of the pixels that move (or do not) whose log-odds exceed a limit.
  double ShareAbove(float limit, bool of_movers) const {
    double all = 0, above = 0;
    for (int k = 0; k < static_cast<int>(moving.total()); ++k) {
      if ((moving(k) != 0) != of_movers) continue;
      ++all;
      above += log_odds(k) > limit ? 1 : 0;
    }
    return above / std::max(all, 1.0);
  }
};

TEST(CompareMotion, OfAStaticHallSaysThatItStands) {
  const Pair pair({}, {0, 0, 0.15}, 0.25);
  EXPECT_LT(pair.ShareAbove(1, false), 0.02);
  EXPECT_LT(cv::mean(pair.log_odds)[0], -0.5);
}

TEST(CompareMotion, GlareThatWandersOverPlainGoodsIsHardlyAMover) {
  test::Panel goods;
  goods.centre = {0.1, -0.1, 3};
  goods.half_width = goods.half_height = 0.8;
  goods.brightness = 140;
  goods.contrast = 12;
  const auto claimed = [&](double shading_noise) {
    SurfaceOptions surface;
    surface.shading_noise = shading_noise;
    Glare glare;
    glare.grey = 90;
    const Pair pair({goods}, {0, 0, 0.03}, 0.05, glare, surface);
    return pair.ShareAbove(0.5, false);
  };
  const double if_unknown = claimed(0);
  EXPECT_GT(if_unknown, 0.001);
  EXPECT_LT(claimed(SurfaceOptions().shading_noise), if_unknown / 4);
}

TEST(CompareMotion, FindsAWalkerAcrossBesideAMovingCamera) {
  const Pair pair({test::Walker({-0.3, 0.1, 3.2}, {1.2, 0, 0})}, {0, 0, 0.03}, 0.05);
  EXPECT_GT(pair.ShareAbove(1, true), 0.5);
  EXPECT_LT(pair.ShareAbove(1, false), 0.02);
}

TEST(CompareMotion, FindsWhomTheRightImageDidNotSeeYetAMomentAgo) {
  const Pair pair({test::Walker({-1.05, 0.1, 1.6}, {1.2, 0, 0})}, {0, 0, 0.03}, 0.05);
  const cv::Rect image({0, 0}, pair.moving.size());
  cv::Mat1f most;  // of the disparities around
  cv::dilate(pair.then.disparity, most, cv::Mat::ones(3, 3, CV_8U));
  int unknown_before = 0, found = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const cv::Vec2f& from = pair.flow(y, x);
      const cv::Point there(cvRound(from[0]), cvRound(from[1]));
      if (pair.moving(y, x) == 0 || pair.now.disparity(y, x) <= 0 || !image.contains(there))
        continue;
      if (most(there) > 0) continue;
      ++unknown_before;
      found += pair.log_odds(y, x) > 1 ? 1 : 0;
    }
  }
  EXPECT_GT(unknown_before, 200);
  EXPECT_GT(found, unknown_before / 2);
  EXPECT_LT(pair.ShareAbove(1, false), 0.02);
}

TEST(CompareMotion, FindsWhomOnlyTheLeftCameraSeesWhileTheRigStands) {
  const auto found = [](const Vector3d& way) {
    test::Panel walker = test::Walker({-0.81, 0.1, 0.7}, {0.3, 0, 0});
    walker.grain_m = 0.01;  // he is near
    const Pair pair({walker}, way, 0.05);
    EXPECT_LT(pair.ShareAbove(1, false), 0.02);
    int pixels = 0, above = 0;
    for (int k = 0; k < static_cast<int>(pair.moving.total()); ++k) {
      if (pair.moving(k) == 0 || pair.now.disparity(k) > 0) continue;
      ++pixels;
      above += pair.log_odds(k) > 1 ? 1 : 0;
    }
    EXPECT_GT(pixels, 1000);
    return static_cast<double>(above) / pixels;
  };
  EXPECT_GT(found({0, 0, 0}), 0.4);
  EXPECT_EQ(found({0, 0, 0.03}), 0);  // he might stand and be near
}

TEST(CompareMotion, FindsAWalkerAlongTheAxisOverALongGap) {
  const Pair pair({test::Walker({0.3, 0.1, 4.5}, {0, 0, -1.0})}, {0, 0, 0.1}, 0.25);
  EXPECT_GT(pair.ShareAbove(1, true), 0.3);
  EXPECT_LT(pair.ShareAbove(1, false), 0.02);
}

/// A wall that the rig passes sideways and that moves by `flow_px` in the image, with a disparity
/// measured as 12 pixels; the pattern repeats after `period` columns. `stereo_px` is its real one.
double MeanLogOddsOfWall(int period, int flow_px, int stereo_px) {
  const cv::Size size(160, 60);
  const auto shifted = [&](int by) {
    cv::Mat1b image(size);
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        const auto column = static_cast<std::uint32_t>((x + by + 10 * period) % period);
        const double grey = 128 + 60 * test::UnitNoise(1, 1, column);
        image(y, x) = cv::saturate_cast<unsigned char>(grey);
      }
    }
    cv::GaussianBlur(image, image, {3, 3}, 0.8);
    return image;
  };
  DenseFrame now, then;
  now.image = shifted(0);
  now.right_low = now.right_high = shifted(stereo_px);
  now.disparity = now.filled = cv::Mat1f(size, 12.0F);
  then = now;
  then.image = shifted(-flow_px);
  cv::Mat2f flow(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      flow(y, x) = cv::Vec2f(static_cast<float>(x + flow_px), static_cast<float>(y));
    }
  }
  const StereoCamera half = HalfCamera({});
  Isometry3d T_then_now = Isometry3d::Identity();
  T_then_now.translation().x() = half.baseline_m / 2;  // half a pixel for each of disparity
  const RobustOptions options;
  const MotionEvidence found = CompareMotion(
      Compared(now, then, flow, T_then_now, 0.25), MeasureTexture(now.image, options.surface),
      LookAround(now, options.surface, options.evidence), half, options.evidence);
  return cv::mean(found.log_odds(cv::Rect(40, 10, 80, 40)))[0];
}

TEST(CompareMotion, IsNotMisledByARepeatingPatternMatchedAPeriodOff) {
  // Static at 4 pixels of disparity: it goes 2, not the 6 that the disparity of 12 would make.
  EXPECT_LT(MeanLogOddsOfWall(8, 2, 4), 0.5);
  // The same wall, and flow that is a period off as well.
  EXPECT_LT(MeanLogOddsOfWall(8, 10, 4), 0.5);
  // The same motion, and stereo that knows no other answer: it moves by itself.
  EXPECT_GT(MeanLogOddsOfWall(1000, 2, 12), 2);
}

constexpr double kMoving = 0.5;  // log-odds from which on a gap says that something moves

TEST(CombineGaps, WhatOneGapFoundIsNotTalkedDownByAShorterOne) {
  const EvidenceOptions options;
  const auto one = [](float value) { return cv::Mat1f(1, 1, value); };
  const auto combined = [&](float a, float b, float c) {
    return CombineGaps({one(a), one(b), one(c)}, kMoving, options)(0, 0);
  };
  EXPECT_GT(combined(-9, 9, 0), 2);
  EXPECT_FLOAT_EQ(combined(-9, -9, -9), 3 * static_cast<float>(options.least));
  EXPECT_FLOAT_EQ(combined(9, 0, 0), static_cast<float>(options.most));
  EXPECT_FLOAT_EQ(combined(0, 0, 0), 0);
}

TEST(CombineGaps, AGapThatWasNotComparedSaysNothing) {
  const cv::Mat1f one(1, 1, -0.5F), two(1, 1, 2.0F);
  EXPECT_FLOAT_EQ(CombineGaps({one, {}, {}}, kMoving, {})(0, 0), -0.5F);
  EXPECT_EQ(CombineGaps({one, {}, two}, kMoving, {})(0, 0),
            CombineGaps({one, cv::Mat1f(1, 1, 0.0F), two}, kMoving, {})(0, 0));
}

TEST(MeasureTexture, IsTheSumOfGradientProductsLessWhatNoiseGives) {
  const cv::Mat1b image = test::Render(test::StaticHall(), {}, Isometry3d::Identity(), 0, 2.0)
                              .left(cv::Rect(100, 100, 60, 40));
  SurfaceOptions options;
  options.brightness_noise = 0;
  cv::Mat gx, gy, sum;
  cv::Sobel(image, gx, CV_64F, 1, 0, 3, 1.0 / 8);
  cv::Sobel(image, gy, CV_64F, 0, 1, 3, 1.0 / 8);
  const Texture texture = MeasureTexture(image, options);
  const double variance = 2 * options.grey_noise * options.grey_noise, noise = 0.1875 / 2 * 49;
  const auto off = [&](const cv::Mat& product, double less, const cv::Mat1f& found) {
    cv::boxFilter(product, sum, CV_64F, {7, 7}, {-1, -1}, false);
    const cv::Mat expected = cv::max(sum / variance - less, less > 0 ? 0.0 : -1e9);
    cv::Mat measured;
    found.convertTo(measured, CV_64F);
    return cv::norm(measured, expected, cv::NORM_INF);
  };
  EXPECT_LT(off(gx.mul(gx), noise, texture.xx), 1e-2);
  EXPECT_LT(off(gy.mul(gy), noise, texture.yy), 1e-2);
  for (int k = 0; k < static_cast<int>(image.total()); ++k) {
    EXPECT_LE(texture.xy(k) * texture.xy(k), texture.xx(k) * texture.yy(k) * 1.0001F);
  }
}

TEST(FollowBack, FindsTheWayOfStaticPixelsToAFractionOfAPixel) {
  const Pair pair({}, {0, 0, 0.1}, 0.2);
  Isometry3d T = Isometry3d::Identity();
  T.translation() = Vector3d(0, 0, 0.1);
  const StaticField expected = WhereStatic(pair.now.filled, T, HalfCamera({}));
  std::vector<double> errors;
  for (int y = 20; y < 220; y += 3) {
    for (int x = 80; x < 350; x += 3) {
      if (pair.now.disparity(y, x) <= 0) continue;
      errors.push_back(cv::norm(pair.flow(y, x) - expected.place(y, x)));
    }
  }
  std::nth_element(errors.begin(), errors.begin() + std::ssize(errors) / 2, errors.end());
  EXPECT_LT(errors[errors.size() / 2], 0.2);
}

constexpr double kTrustInRegion = 0.02;

TEST(MatchesAlong, AreOnePerCellAndFollowTheRigsMotion) {
  const Pair pair({}, {0, 0, 0.05}, 0.05);
  const auto matches = MatchesAlong(pair.points, pair.flow, pair.expected, pair.now, pair.then,
                                    ForgottenMemory(pair.now.image.size(), 0), kTrustInRegion);
  ASSERT_GT(matches.size(), 200U);
  EXPECT_LE(matches.size(), static_cast<std::size_t>((376 / 12 + 1) * (240 / 12)));
  Isometry3d T_now_then = Isometry3d::Identity();
  T_now_then.translation() = Vector3d(0, 0, -0.05);
  const auto follow = std::count_if(matches.begin(), matches.end(), [&](const StereoMatch& match) {
    return MatchChi2({}, T_now_then, match, {0.3, 0.3, 0.6}) < 11.34;
  });
  EXPECT_GT(follow, std::ssize(matches) * 8 / 10);
}

TEST(MatchesAlong, FindTheirWayWhereTheFlowIsAnothers) {
  const Pair pair({}, {0, 0, 0.05}, 0.05);
  cv::Mat2f anothers;
  cv::add(pair.flow, cv::Scalar(9, -4), anothers);
  const auto count = [&](const cv::Mat2f& flow) {
    const auto matches = MatchesAlong(pair.points, flow, pair.expected, pair.now, pair.then,
                                      ForgottenMemory(pair.now.image.size(), 0), kTrustInRegion);
    Isometry3d T_now_then = Isometry3d::Identity();
    T_now_then.translation() = Vector3d(0, 0, -0.05);
    return std::count_if(matches.begin(), matches.end(), [&](const StereoMatch& match) {
      return MatchChi2({}, T_now_then, match, {0.3, 0.3, 0.6}) < 11.34;
    });
  };
  EXPECT_GT(count(anothers), count(pair.flow) * 9 / 10);
}

TEST(MatchesAlong, WhatARegionCoversIsHardlyTrusted) {
  const Pair pair({}, {0, 0, 0.05}, 0.05);
  LabelMemory memory = ForgottenMemory(pair.now.image.size(), 0);
  memory.regions.labels.colRange(0, 188).setTo(1);
  for (const StereoMatch& match : MatchesAlong(pair.points, pair.flow, pair.expected, pair.now,
                                               pair.then, memory, kTrustInRegion)) {
    EXPECT_EQ(match.weight <= kTrustInRegion, match.now.x() < 2 * 188) << match.now.transpose();
  }
}

TEST(FillRows, GapsTakeTheFartherSide) {
  cv::Mat1f disparity(2, 12, 9.0F);
  disparity.colRange(6, 12).setTo(4.0F);
  disparity.colRange(4, 8).setTo(-1.0F);
  disparity(1, 0) = -1;
  const cv::Mat1f filled = FillRows(disparity);
  EXPECT_EQ(filled(0, 3), 9);
  EXPECT_EQ(filled(0, 4), 4);
  EXPECT_EQ(filled(0, 7), 4);
  EXPECT_EQ(filled(1, 0), 9);
}

TEST(EarlierDisparity, IsAnythingBetweenGoingAlongAndComingTowards) {
  const EarlierDisparity of_who_is_approached(12, 10), of_who_is_left(10, 12);
  for (const float sensible : {8.0F, 9.0F, 10.0F, 11.0F, 12.0F}) {
    EXPECT_EQ(of_who_is_approached.DistanceTo(sensible), 0) << sensible;
  }
  EXPECT_FLOAT_EQ(of_who_is_approached.DistanceTo(5), 3);
  EXPECT_FLOAT_EQ(of_who_is_approached.DistanceTo(14), 2);
  EXPECT_EQ(of_who_is_left.DistanceTo(14), 0);
  EXPECT_FLOAT_EQ(of_who_is_left.DistanceTo(9), 1);
}

TEST(EarlierDisparity, IsThatOfNowWhereTheStaticOneIsBehindTheCamera) {
  EXPECT_FLOAT_EQ(EarlierDisparity(12, -1).DistanceTo(10), 2);
  EXPECT_EQ(EarlierDisparity(12, 0).DistanceTo(12), 0);
}

TEST(EarlierDisparity, IsNeverLessThanNothing) {
  EXPECT_FLOAT_EQ(EarlierDisparity(4, 1).DistanceTo(-1), 1);  // 2 * 1 - 4 is no disparity
}

TEST(CarryMemory, TakesAMoversMemoryAlongAndLeavesNoTrail) {
  DenseFrame before, now;
  before.disparity = before.filled = cv::Mat1f(60, 80, 3.0F);
  before.disparity(cv::Rect(20, 10, 10, 30)).setTo(12.0F);
  now.disparity = cv::Mat1f(60, 80, 3.0F);
  now.disparity(cv::Rect(25, 10, 10, 30)).setTo(12.0F);
  now.filled = now.disparity;
  LabelMemory memory = ForgottenMemory({80, 60}, 0);
  memory.log_odds.setTo(-3.0F);
  memory.log_odds(cv::Rect(20, 10, 10, 30)).setTo(5.0F);
  cv::Mat2f flow(60, 80);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) {
      const float way = x >= 22 && x < 38 ? -5.0F : 0.0F;  // spills over the outline
      flow(y, x) = {static_cast<float>(x) + way, static_cast<float>(y)};
    }
  }
  const cv::Mat1f carried =
      CarryMemory(memory, flow, now.filled, now, before, kUsualTolerance).log_odds;
  for (int x = 0; x < 80; ++x) {
    EXPECT_EQ(carried(20, x) > 0, x >= 25 && x < 35) << "column " << x;
  }
}

/// Log-odds of 5 everywhere, of 60 rows and 80 columns, carried by a flow that leads nowhere.
cv::Mat1f CarriedInPlace(const cv::Mat1f& if_static, const DenseFrame& now,
                         const DenseFrame& before) {
  LabelMemory memory = ForgottenMemory({80, 60}, 0);
  memory.log_odds.setTo(5.0F);
  cv::Mat2f flow(60, 80);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) flow(y, x) = {static_cast<float>(x), static_cast<float>(y)};
  }
  return CarryMemory(memory, flow, if_static, now, before, kUsualTolerance).log_odds;
}

TEST(CarryMemory, KnowsASurfaceThatTheRigHasComeNearer) {
  DenseFrame before, now;
  now.disparity = now.filled = cv::Mat1f(60, 80, 12.0F);
  const cv::Mat1f if_static(60, 80, 10.0F);
  before.disparity = cv::Mat1f(60, 80);
  before.disparity.colRange(0, 20).setTo(12.0F);   // went along with the rig
  before.disparity.colRange(20, 40).setTo(10.0F);  // stood
  before.disparity.colRange(40, 60).setTo(8.0F);   // came towards it
  before.disparity.colRange(60, 80).setTo(5.0F);   // is another surface
  before.filled = before.disparity;
  const cv::Mat1f carried = CarriedInPlace(if_static, now, before);
  for (int x = 0; x < 80; ++x) EXPECT_EQ(carried(20, x) > 0, x <= 60) << "column " << x;
}

/// The rig has come so far that anything up to what it was, or nothing at all, makes sense.
TEST(CarryMemory, AnUnknownDisparityIsNotTakenForASmallOne) {
  DenseFrame before, now;
  now.disparity = now.filled = cv::Mat1f(60, 80, 10.0F);
  const cv::Mat1f if_static(60, 80, 5.0F);
  before.disparity = cv::Mat1f(60, 80, 0.5F);
  before.disparity.colRange(40, 80).setTo(kNoDisparity);
  before.filled = before.disparity;
  const cv::Mat1f carried = CarriedInPlace(if_static, now, before);
  for (const int y : {0, 20}) {  // at the image's border, and within
    for (int x = 0; x < 80; ++x) EXPECT_EQ(carried(y, x) > 0, x <= 40) << "column " << x;
  }
}

TEST(CarryMemory, FollowsTheFlowAloneBeyondTheRightImageAndNowhereElse) {
  DenseFrame before, now;
  before.disparity = before.filled = cv::Mat1f(60, 80, 3.0F);
  now.disparity = cv::Mat1f(60, 80, 3.0F);
  now.disparity.colRange(0, 20).setTo(kNoDisparity);   // beyond the right image
  now.disparity.colRange(40, 50).setTo(kNoDisparity);  // hidden from the right camera
  now.disparity.row(50).setTo(kNoDisparity);
  now.filled = cv::Mat1f(60, 80, 1.0F);  // another surface than the mover's
  LabelMemory memory = ForgottenMemory({80, 60}, 0);
  memory.log_odds.setTo(5.0F);
  cv::Mat2f flow(60, 80);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) flow(y, x) = {static_cast<float>(x + 5), static_cast<float>(y)};
  }
  const cv::Mat1f carried =
      CarryMemory(memory, flow, now.filled, now, before, kUsualTolerance).log_odds;
  for (int x = 0; x < 80; ++x) EXPECT_EQ(carried(20, x) > 0, x < 20) << "column " << x;
  for (int x = 0; x < 80; ++x) EXPECT_EQ(carried(50, x), 0) << "column " << x;
}

}  // namespace
}  // namespace aisle::slam::dynamic
