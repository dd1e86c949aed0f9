#include "slam/map/triangulate_landmarks.h"

#include <gtest/gtest.h>

#include <random>

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
      frame->features.keypoints.push_back({pixel, 0, 0, 50});
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

  StereoCamera camera;
  std::vector<Eigen::Vector3d> points;
  std::vector<Descriptor> descriptors;
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

}  // namespace
}  // namespace aisle::slam
