#include "slam/mapping/map_part.h"

#include <gtest/gtest.h>

namespace aisle::slam {
namespace {

/// A frame with so many stereo points a few metres ahead.
std::shared_ptr<const Frame> Seeing(int points) {
  auto frame = std::make_shared<Frame>();
  for (int i = 0; i < points; ++i) {
    frame->features.keypoints.emplace_back();
    frame->features.descriptors.emplace_back();
    frame->measurements.push_back({{100.0 + i, 200, 20}, 1, 0.2});
  }
  return frame;
}

Eigen::Isometry3d Away() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << 5, 0, 2;
  return pose;
}

/// A map of so many keyframes, each the child of the one before.
Map Drive(int keyframes) {
  Map map;
  for (int k = 0; k < keyframes; ++k) {
    auto part = BeginPart(map, Seeing(80), Eigen::Isometry3d::Identity(), {},
                          {.create = {}, .keeps_world = true});
    if (k > 0) part->edit.new_keyframes[0].parent = {k - 1};
    map.Apply(part->edit);
  }
  return map;
}

TEST(BeginPart, NothingWhereTheFrameShowsTooLittleDepth) {
  const NewPartOptions options;
  EXPECT_FALSE(BeginPart({}, Seeing(options.least_points - 1), Away(), {}, options));
  EXPECT_TRUE(BeginPart({}, Seeing(options.least_points), Away(), {}, options));
}

TEST(BeginPart, TheKeyframeStandsWhereItIsSaidAndItsLandmarksBeforeIt) {
  const StereoCamera camera;
  const auto part = BeginPart(Drive(7), Seeing(80), Away(), camera, {});
  ASSERT_TRUE(part);
  ASSERT_EQ(part->edit.new_keyframes.size(), 1U);
  const Keyframe& keyframe = part->edit.new_keyframes[0];
  EXPECT_EQ(keyframe.T_world_rig.matrix(), Away().matrix());
  EXPECT_FALSE(keyframe.parent.valid());  // a part of its own
  ASSERT_EQ(part->edit.new_landmarks.size(), 80U);
  const Eigen::Vector3d ahead = Away() * Backproject(camera, keyframe.frame->measurements[0].uvd);
  EXPECT_TRUE(part->edit.new_landmarks[0].position.isApprox(ahead, 1e-12));
}

TEST(BeginPart, AMapOfAFewKeyframesIsGivenUpUnlessItsWorldMustStay) {
  const NewPartOptions options;
  const auto few = BeginPart(Drive(options.least_keyframes - 1), Seeing(80), Away(), {}, options);
  ASSERT_TRUE(few);
  EXPECT_TRUE(few->anew);
  EXPECT_EQ(few->edit.new_keyframes[0].id, KeyframeId{0});
  const auto enough = BeginPart(Drive(options.least_keyframes), Seeing(80), Away(), {}, options);
  ASSERT_TRUE(enough);
  EXPECT_FALSE(enough->anew);
  EXPECT_EQ(enough->edit.new_keyframes[0].id, KeyframeId{options.least_keyframes});
  const auto loaded =
      BeginPart(Drive(1), Seeing(80), Away(), {}, {.create = {}, .keeps_world = true});
  ASSERT_TRUE(loaded);
  EXPECT_FALSE(loaded->anew);
}

TEST(IsInFirstPart, KeyframesOfALaterPartAreNot) {
  Map map = Drive(6);
  map.Apply(BeginPart(map, Seeing(80), Away(), {}, {})->edit);
  EXPECT_TRUE(IsInFirstPart(map, {0}));
  EXPECT_TRUE(IsInFirstPart(map, {5}));
  EXPECT_FALSE(IsInFirstPart(map, {6}));
  MapEdit join;
  join.parents = {{{6}, {5}}};
  map.Apply(join);
  EXPECT_TRUE(IsInFirstPart(map, {6}));
}

}  // namespace
}  // namespace aisle::slam
