#include "slam/optimize/adjust_map.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/slam/mapping/ring_world.h"

namespace aisle::slam {
namespace {

/// Three keyframes in a row that see the same points exactly, with disparity.
class ThreeKeyframes : public testing::Test {
 protected:
  void SetUp() override {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> x(-3, 3), y(-2, 2), z(3, 8);
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 80; ++i) points.emplace_back(x(random), y(random), z(random));
    for (int k = 0; k < 3; ++k) {
      truth.emplace_back(0.3 * k, 0, 0.1 * k);
      AddKeyframe(points);
    }
    MapEdit edit;
    for (int i = 0; i < 80; ++i) {
      Landmark landmark;
      landmark.position = points[static_cast<std::size_t>(i)];
      for (int k = 0; k < 3; ++k) landmark.observations.push_back({{k}, i});
      landmark.created_by = {0};
      edit.new_landmarks.push_back(landmark);
    }
    map.Apply(edit);
  }

  void AddKeyframe(const std::vector<Eigen::Vector3d>& points) {
    auto frame = std::make_shared<Frame>();
    for (const Eigen::Vector3d& point : points) {
      const Eigen::Vector3d uvd = Project(camera, point - truth.back());
      const cv::Point2f pixel(static_cast<float>(uvd.x()), static_cast<float>(uvd.y()));
      frame->features.keypoints.push_back({pixel, 0, 0, 50});
      frame->features.descriptors.push_back({});
      frame->measurements.push_back({uvd, 1, 0.5});
    }
    frame->grid = FeatureGrid(frame->features.keypoints, {camera.width, camera.height});
    Keyframe keyframe;
    keyframe.id = map.NextKeyframeId();
    keyframe.frame = frame;
    keyframe.T_world_rig.translation() = truth.back();
    if (keyframe.id.value > 0) keyframe.parent = {keyframe.id.value - 1};
    keyframe.landmarks.resize(points.size());
    MapEdit edit;
    edit.new_keyframes = {keyframe};
    map.Apply(edit);
  }

  /// How far the last keyframe stands from where it should after adjusting around it.
  double ErrorAfterAdjusting() {
    map.Apply(AdjustLocally(map, {2}, camera, {}).edit);
    return (map.At(KeyframeId{2}).T_world_rig.translation() - truth[2]).norm();
  }

  StereoCamera camera;
  std::vector<Eigen::Vector3d> truth;
  Map map;
};

TEST_F(ThreeKeyframes, AdjustLocallyFindsBackAPoseThatIsOff) {
  Eigen::Isometry3d off = map.At(KeyframeId{2}).T_world_rig;
  off.translation() += Eigen::Vector3d(0.15, -0.05, 0.1);
  MapEdit edit;
  edit.poses = {{{2}, off}};
  map.Apply(edit);
  EXPECT_LT(ErrorAfterAdjusting(), 1e-3);
}

TEST_F(ThreeKeyframes, APointBehindTheCameraSpoilsNothing) {
  Eigen::Isometry3d off = map.At(KeyframeId{2}).T_world_rig;
  off.translation() += Eigen::Vector3d(0.15, -0.05, 0.1);
  MapEdit edit;
  edit.poses = {{{2}, off}};
  const LandmarkId astray = map.Landmarks().front()->id;
  edit.positions = {{astray, {0.5, 0.2, -4}}};
  map.Apply(edit);
  EXPECT_LT(ErrorAfterAdjusting(), 1e-3);
}

/// How far a keyframe of `after` stands from where it does in `before`.
double MovedM(const Map& before, const Map& after, KeyframeId id) {
  return (before.At(id).T_world_rig.translation() - after.At(id).T_world_rig.translation()).norm();
}

TEST(AdjustLocally, AFewLandmarksFromOutsideDoNotTurnTheSurroundingsAbout) {
  for (const int through_dark : {0, 1, 2, 3, 10}) {
    for (unsigned seed = 1; seed <= 4; ++seed) {
      // Two keyframes that know so many landmarks of those before them.
      const RingWorld ring({.again = -23,
                            .noise_px = 0.7,
                            .seed = seed,
                            .dark_before = 15,
                            .through_dark = through_dark});
      Map adjusted = ring.map();
      adjusted.Apply(AdjustLocally(adjusted, {16}, ring.camera(), {}).edit);
      EXPECT_LT(MovedM(ring.map(), adjusted, {15}), 0.01) << through_dark << " seed " << seed;
    }
  }
}

TEST(AdjustGlobally, WhatSharesNoLandmarksKeepsItsPlaceToTheKeyframeItWasTrackedFrom) {
  for (const int through_dark : {0, 3}) {
    for (unsigned seed = 1; seed <= 3; ++seed) {
      const RingWorld ring({.again = -10,
                            .points = 1500,
                            .noise_px = 0.7,
                            .seed = seed,
                            .dark_before = 15,
                            .through_dark = through_dark});
      Map map = ring.map();
      // The keyframes of both sides are off by what the measurements tell ...
      MapEdit off;
      for (const int k : {13, 14, 20}) {
        off.poses.push_back({{k}, map.At(KeyframeId{k}).T_world_rig});
        off.poses.back().T_world_rig.translation().x() += 0.05;
      }
      map.Apply(off);
      Map adjusted = map;
      adjusted.Apply(AdjustGlobally(map, ring.camera(), {}).edit);
      EXPECT_GT(MovedM(map, adjusted, {14}), 0.03);
      EXPECT_GT(MovedM(map, adjusted, {20}), 0.03);
      // ... and of what lies between nothing tells.
      const auto step = [](const Map& of) {
        return of.At(KeyframeId{14}).T_world_rig.inverse() * of.At(KeyframeId{15}).T_world_rig;
      };
      EXPECT_TRUE(step(adjusted).isApprox(step(map), 1e-9)) << through_dark << " seed " << seed;
    }
  }
}

}  // namespace
}  // namespace aisle::slam
