#include "slam/map/triangulate_landmarks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

namespace aisle::slam {
namespace {

/// Keyframes that see the same points with one camera: features without any disparity.
class Monocular : public testing::Test {
 protected:
  void SetUp() override {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> x(-3, 3), y(-2, 2), z(6, 14);
    for (int i = 0; i < 100; ++i) {
      points.emplace_back(x(random), y(random), z(random));
      descriptors.push_back({random(), random(), random(), random()});
    }
  }

  KeyframeId See(const Eigen::Vector3d& from, double noise_px = 0) {
    std::mt19937_64 random(static_cast<std::uint64_t>(map.NextKeyframeId().value) + 1);
    std::normal_distribution<double> noise(0, noise_px > 0 ? noise_px : 1);
    auto frame = std::make_shared<Frame>();
    for (std::size_t i = 0; i < points.size(); ++i) {
      Eigen::Vector3d uvd = Project(camera, points[i] - from);
      if (noise_px > 0) uvd += Eigen::Vector3d(noise(random), noise(random), 0);
      const cv::Point2f pixel(static_cast<float>(uvd.x()), static_cast<float>(uvd.y()));
      frame->features.keypoints.push_back({pixel, LevelAt((points[i] - from).norm()), 0, 50});
      frame->features.descriptors.push_back(descriptors[i]);
      frame->measurements.push_back({{uvd.x(), uvd.y(), 0}, 1, 0});
    }
    frame->grid = FeatureGrid(frame->features.keypoints, {camera.width, camera.height});
    Keyframe keyframe;
    keyframe.id = map.NextKeyframeId();
    keyframe.frame = frame;
    keyframe.T_world_rig.translation() = from;
    if (keyframe.id.value > 0) keyframe.parent = {keyframe.id.value - 1};
    keyframe.landmarks.resize(points.size());
    MapEdit edit;
    edit.new_keyframes = {keyframe};
    map.Apply(edit);
    return keyframe.id;
  }

  /// That of a corner at its own size, which shrinks with the distance; 0 where no size is asked.
  int LevelAt(double distance_m) const {
    if (level_0_at_m == 0) return 0;
    return static_cast<int>(std::lround(std::log(level_0_at_m / distance_m) / std::log(1.2)));
  }

  /// As many points again, each `off` from one that is there, looking like nothing else.
  void AddTwins(const Eigen::Vector3d& off) {
    std::mt19937_64 random(12);
    const std::vector<Eigen::Vector3d> before = points;
    for (const Eigen::Vector3d& point : before) {
      points.push_back(point + off);
      descriptors.push_back({random(), random(), random(), random()});
    }
  }

  /// See, where points look `bits` other than they do, and their twins `twin_bits` other than those
  /// whose twins they are.
  KeyframeId SeeLookAlikes(const Eigen::Vector3d& from, int bits, int twin_bits) {
    const std::vector<Descriptor> true_looks = descriptors;
    const std::size_t half = points.size() / 2;
    for (std::size_t i = 0; i < half; ++i) {
      descriptors[i] = Flipped(true_looks[i], 0, bits);
      descriptors[half + i] = Flipped(true_looks[i], 1, twin_bits);
    }
    const KeyframeId id = See(from);
    descriptors = true_looks;
    return id;
  }

  static Descriptor Flipped(Descriptor descriptor, std::size_t word, int bits) {
    descriptor[word] ^= (std::uint64_t{1} << bits) - 1;
    return descriptor;
  }

  /// That each landmark is the point which it says both views show, and no feature shows two.
  void ExpectTrue(const std::vector<Landmark>& landmarks) const {
    std::set<Observation> observed;
    for (const Landmark& landmark : landmarks) {
      const auto point = static_cast<std::size_t>(landmark.observations[0].feature);
      EXPECT_LT((landmark.position - points[point]).norm(), 1e-6);
      for (const Observation& observation : landmark.observations) {
        EXPECT_TRUE(observed.insert(observation).second) << "feature " << observation.feature;
      }
    }
  }

  StereoCamera camera;
  std::vector<Eigen::Vector3d> points;
  std::vector<Descriptor> descriptors;
  double level_0_at_m = 0;  ///< distance at which a corner shows at level 0; 0: at any
  Map map;
};

TEST_F(Monocular, PlacesEveryPointThatBothSee) {
  const KeyframeId before = See({0, 0, 0}), newest = See({1, 0.1, 0.2});
  const auto landmarks = TriangulateLandmarks(map, newest, {before}, camera, {});
  ASSERT_EQ(landmarks.size(), points.size());
  for (const Landmark& landmark : landmarks) {
    const auto& [first, second] = std::tie(landmark.observations[0], landmark.observations[1]);
    EXPECT_EQ(first.keyframe, before);
    EXPECT_EQ(first.feature, second.feature);
    const Eigen::Vector3d& truth = points[static_cast<std::size_t>(first.feature)];
    EXPECT_LT((landmark.position - truth).norm(), 1e-6);
  }
}

TEST_F(Monocular, BesidesNoiseEveryPointIsWithinItsStatedShareOfDepth) {
  const KeyframeId before = See({0, 0, 0}, 0.5), newest = See({1.5, 0, 0}, 0.5);
  const auto landmarks = TriangulateLandmarks(map, newest, {before}, camera, {});
  EXPECT_GT(landmarks.size(), 50u);
  for (const Landmark& landmark : landmarks) {
    const auto point = static_cast<std::size_t>(landmark.observations[0].feature);
    EXPECT_LT((landmark.position - points[point]).norm(), 3 * 0.1 * points[point].norm());
  }
}

TEST_F(Monocular, WithoutParallaxNothingIsPlaced) {
  const KeyframeId before = See({0, 0, 0}), close = See({0.1, 0, 0}), ahead = See({0.15, 0, 0});
  EXPECT_TRUE(TriangulateLandmarks(map, close, {before}, camera, {}).empty());
  EXPECT_TRUE(TriangulateLandmarks(map, ahead, {before}, camera, {}).empty());
  EXPECT_TRUE(TriangulateLandmarks(map, ahead, {}, camera, {}).empty());
}

TEST_F(Monocular, WhatHasMovedOffItsEpipolarLineIsNotMatched) {
  const KeyframeId before = See({0, 0, 0});
  for (Eigen::Vector3d& point : points) point.y() += 0.4;
  const KeyframeId newest = See({1, 0, 0});
  EXPECT_TRUE(TriangulateLandmarks(map, newest, {before}, camera, {}).empty());
}

TEST_F(Monocular, WhatComesNearerIsPlacedUpToTwoLevelsAbove) {
  level_0_at_m = 16;
  const Eigen::Vector3d there(0, 0, 0), here(3, 0, 3.5);
  const KeyframeId before = See(there), newest = See(here);
  std::map<int, int> at_levels_apart;
  for (const Eigen::Vector3d& point : points) {
    ++at_levels_apart[LevelAt((point - here).norm()) - LevelAt((point - there).norm())];
  }
  ASSERT_GT(at_levels_apart[2], 10);
  ASSERT_GT(at_levels_apart[3], 5);
  std::map<int, int> placed;
  const auto landmarks = TriangulateLandmarks(map, newest, {before}, camera, {});
  ExpectTrue(landmarks);
  for (const Landmark& landmark : landmarks) {
    const Eigen::Vector3d& point = landmark.position;
    ++placed[LevelAt((point - here).norm()) - LevelAt((point - there).norm())];
  }
  for (const auto& [apart, count] : at_levels_apart) {
    EXPECT_EQ(placed[apart], std::abs(apart) <= 2 ? count : 0) << apart << " levels apart";
  }
}

TEST_F(Monocular, WhatComesNearerAndIsSeenNoLargerIsSomethingElse) {
  level_0_at_m = 16;
  const KeyframeId before = See({0, 0, 0});
  level_0_at_m /= std::pow(1.2, 5);  // five levels less than it ought to be
  const KeyframeId newest = See({3, 0, 3.5});
  EXPECT_TRUE(TriangulateLandmarks(map, newest, {before}, camera, {}).empty());
}

TEST_F(Monocular, OfTwoThatLookAlikeOnTheLineNeitherIsTaken) {
  const std::size_t alone = points.size();
  AddTwins({0.4, 0, 0});  // in the same row, along which the rig moves
  const KeyframeId before = SeeLookAlikes({0, 0, 0}, 10, 11),
                   clear = SeeLookAlikes({0, 0, 0}, 10, 30);
  const KeyframeId newest = See({1, 0, 0});
  EXPECT_TRUE(TriangulateLandmarks(map, newest, {before}, camera, {}).empty());
  const auto landmarks = TriangulateLandmarks(map, newest, {clear}, camera, {});
  EXPECT_EQ(landmarks.size(), alone);
  ExpectTrue(landmarks);
}

TEST_F(Monocular, WhatLooksAlikeOffTheLineMisleadsNobody) {
  const std::size_t alone = points.size();
  AddTwins({0, 0.4, 0});
  const KeyframeId before = SeeLookAlikes({0, 0, 0}, 10, 0), newest = See({1, 0, 0});
  const auto landmarks = TriangulateLandmarks(map, newest, {before}, camera, {});
  EXPECT_EQ(landmarks.size(), alone);
  ExpectTrue(landmarks);
}

TEST_F(Monocular, AFeatureThereIsOfOneLandmarkAtMost) {
  const KeyframeId before = See({0, 0, 0});
  const std::size_t alone = points.size();
  AddTwins({0, 0, 0});
  for (std::size_t i = 0; i < alone; ++i) descriptors[alone + i] = descriptors[i];
  const KeyframeId newest = See({1, 0, 0});  // shows each point twice
  const auto landmarks = TriangulateLandmarks(map, newest, {before}, camera, {});
  EXPECT_EQ(landmarks.size(), alone);
  ExpectTrue(landmarks);
}

TEST_F(Monocular, TwoViewsNearerThanTheTwoCamerasPlaceNothing) {
  for (Eigen::Vector3d& point : points) point /= 6;  // so near that any of these steps would do
  const KeyframeId before = See({0, 0, 0});
  const KeyframeId nearer = See({0.9 * camera.baseline_m, 0, 0});
  const KeyframeId further = See({1.1 * camera.baseline_m, 0, 0});
  EXPECT_TRUE(TriangulateLandmarks(map, nearer, {before}, camera, {}).empty());
  EXPECT_EQ(TriangulateLandmarks(map, further, {before}, camera, {}).size(), points.size());
}

/// Two keyframes of one feature each, at these levels.
TEST(SizesFit, WhereAPointIsSeenLargerByAsMuchAsItIsNearer) {
  const auto view = [](int level) {
    auto frame = std::make_shared<Frame>();
    frame->features.keypoints.push_back({{}, level, 0, 50});
    Keyframe keyframe;
    keyframe.frame = frame;
    return keyframe;
  };
  const StereoCamera camera;
  for (const auto& [level_here, level_there] : {std::pair(0, 0), {4, 0}, {0, 4}, {7, 2}, {1, 3}}) {
    const Keyframe here = view(level_here), there = view(level_there);
    const TwoViews views{here, there, camera, Eigen::Isometry3d::Identity()};
    const double fitting_m = 5 * std::pow(1.2, level_here - level_there);
    for (const double off : {1.0, 1.7, 1 / 1.7}) {
      EXPECT_TRUE(SizesFit(views, 0, 0, 5, off * fitting_m)) << level_here << ' ' << level_there;
    }
    for (const double off : {1.9, 1 / 1.9}) {
      EXPECT_FALSE(SizesFit(views, 0, 0, 5, off * fitting_m)) << level_here << ' ' << level_there;
    }
  }
}

TEST(Agrees, ADisparityThatSharesItsColumnsErrorIsOffNoFurtherThanThat) {
  const StereoCamera camera;
  const Eigen::Vector3d point(0.3, -0.2, 4), uvd = Project(camera, point);
  const auto agrees = [&](const Eigen::Vector3d& off, double u_in_d) {
    return Agrees(camera, point, {uvd + off, 1, 0.5, u_in_d});
  };
  // Two deviations of the left column, the right one exact.
  EXPECT_TRUE(agrees({2, 0, 2}, 1));
  EXPECT_FALSE(agrees({2, 0, -2}, 1));
  EXPECT_FALSE(agrees({2, 0, 2}, 0));
  // Chi-square of three numbers is 7.815 at most: of the disparity alone, 2.8 deviations.
  for (const double u_in_d : {0.0, 1.0}) {
    EXPECT_TRUE(agrees({0, 0, 1.3}, u_in_d));
    EXPECT_FALSE(agrees({0, 0, 1.5}, u_in_d));
  }
}

}  // namespace
}  // namespace aisle::slam
