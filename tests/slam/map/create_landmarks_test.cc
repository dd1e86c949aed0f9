#include "slam/map/create_landmarks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace aisle::slam {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A keyframe whose features have these deviations of depth over depth; 0: no depth.
Keyframe KeyframeWith(const std::vector<double>& depth_ratios) {
  auto frame = std::make_shared<Frame>();
  for (const double ratio : depth_ratios) {
    constexpr double kDisparity = 5;
    frame->measurements.push_back(
        {.uvd = {300, 200, ratio > 0 ? kDisparity : 0}, .sigma_d = ratio * kDisparity});
  }
  Keyframe keyframe;
  keyframe.frame = frame;
  keyframe.landmarks.resize(depth_ratios.size());
  return keyframe;
}

std::vector<int> FeaturesOf(const std::vector<Landmark>& landmarks) {
  std::vector<int> features;
  for (const Landmark& landmark : landmarks) {
    features.push_back(landmark.observations.front().feature);
  }
  return features;
}

TEST(CreateLandmarks, TakesEveryPointOfGoodDepthAndNoOtherWhereTheySuffice) {
  const Keyframe keyframe = KeyframeWith({0.05, 0, 0.2, 0.01, 0.09});
  EXPECT_THAT(FeaturesOf(CreateLandmarks(keyframe, {}, {.least = 3})), ElementsAre(0, 3, 4));
  EXPECT_THAT(FeaturesOf(CreateLandmarks(keyframe, {}, {.least = 0})), ElementsAre(0, 3, 4));
}

TEST(CreateLandmarks, WhereTheyDoNotSufficeTheBestOfTheOthersMakeUpTheNumber) {
  const Keyframe keyframe = KeyframeWith({0.4, 0.05, 0, 0.15, 0.7, 0.3});
  EXPECT_THAT(FeaturesOf(CreateLandmarks(keyframe, {}, {.least = 3})), ElementsAre(1, 3, 5));
  EXPECT_THAT(FeaturesOf(CreateLandmarks(keyframe, {}, {.least = 9})), ElementsAre(0, 1, 3, 5))
      << "neither those without depth nor those beyond the worst";
}

TEST(CreateLandmarks, LandmarksThatTheKeyframeNamesCount) {
  Keyframe keyframe = KeyframeWith({0.05, 0.2, 0.3, 0});
  keyframe.landmarks[0] = {7};
  keyframe.landmarks[3] = {8};
  EXPECT_THAT(CreateLandmarks(keyframe, {}, {.least = 2}), IsEmpty());
  EXPECT_THAT(FeaturesOf(CreateLandmarks(keyframe, {}, {.least = 3})), ElementsAre(1));
}

/// Whatever the numbers: never a point that is worse than one left out, and no more than asked for
/// beyond the good ones.
TEST(CreateLandmarks, NoPointIsTakenBeforeABetterOne) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> ratio(0.001, 0.8);
  for (int round = 0; round < 200; ++round) {
    std::vector<double> ratios(random() % 40);
    for (double& one : ratios) one = ratio(random);
    CreateLandmarksOptions options;
    options.least = static_cast<int>(random() % 30);
    const std::vector<int> taken = FeaturesOf(CreateLandmarks(KeyframeWith(ratios), {}, options));
    double worst_taken = 0, best_left = 1;
    int good = 0;
    for (int i = 0; i < std::ssize(ratios); ++i) {
      const double one = ratios[static_cast<std::size_t>(i)];
      good += one < options.worst_depth_ratio ? 1 : 0;
      if (std::binary_search(taken.begin(), taken.end(), i)) {
        worst_taken = std::max(worst_taken, one);
      } else {
        best_left = std::min(best_left, one);
      }
    }
    EXPECT_LE(worst_taken, best_left);
    EXPECT_LT(worst_taken, options.worst_depth_ratio_then);
    EXPECT_LE(std::ssize(taken), std::max(good, options.least));
  }
}

TEST(CreateLandmarks, ADepthIsAsGoodAsItsDisparityHoweverThatWasMeasured) {
  // The same disparity, as such and as the difference of two columns each of which deviates less.
  const auto keyframe_with = [](double sigma_px, double sigma_d, double u_in_d) {
    Keyframe keyframe = KeyframeWith({0.1});
    auto frame = std::make_shared<Frame>(*keyframe.frame);
    frame->measurements[0].sigma_px = sigma_px;
    frame->measurements[0].sigma_d = sigma_d;
    frame->measurements[0].u_in_d = u_in_d;
    keyframe.frame = frame;
    return keyframe;
  };
  for (const double sigma : {0.3, 0.45, 0.48, 0.52, 0.7}) {  // around a tenth of 5 pixels
    const double column = sigma / std::sqrt(2);
    const Keyframe as_such = keyframe_with(column, sigma, 0);
    const Keyframe of_columns = keyframe_with(column, column, 1);
    EXPECT_EQ(CreateLandmarks(of_columns, {}, {.least = 0}).size(),
              CreateLandmarks(as_such, {}, {.least = 0}).size())
        << sigma;
  }
}

/// The deviation's definition: of a left column less a right one.
TEST(Measurement, DisparitySigmaIsTheDeviationOfTheDisparity) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  const Measurement measurement{{300, 200, 5}, 0.7, 0.4, 1};
  double sum = 0;
  constexpr int kDraws = 20000;
  for (int i = 0; i < kDraws; ++i) {
    const double u = measurement.sigma_px * normal(random);
    const double d = measurement.sigma_d * normal(random) + measurement.u_in_d * u;
    sum += d * d;
  }
  EXPECT_NEAR(std::sqrt(sum / kDraws) / DisparitySigma(measurement), 1, 0.03);
}

}  // namespace
}  // namespace aisle::slam
