#include "slam/map/successor.h"

#include <gtest/gtest.h>

namespace aisle::slam {
namespace {

/// Keyframe 0 with a landmark on each of its two features.
Map TwoLandmarks() {
  auto frame = std::make_shared<Frame>();
  for (int i = 0; i < 2; ++i) {
    frame->features.keypoints.emplace_back();
    frame->features.descriptors.emplace_back();
    frame->measurements.push_back({{10.0 * i, 10, 20}, 1, 1});
  }
  MapEdit edit;
  Keyframe keyframe;
  keyframe.id = {0};
  keyframe.frame = frame;
  keyframe.landmarks.resize(2);
  edit.new_keyframes = {keyframe};
  for (int i = 0; i < 2; ++i) {
    Landmark landmark;
    landmark.position = {1.0 * i, 0, 5};
    landmark.observations = {{{0}, i}};
    landmark.created_by = {0};
    edit.new_landmarks.push_back(landmark);
  }
  Map map;
  map.Apply(edit);
  return map;
}

TEST(SuccessorOf, ALandmarkThatIsStillThereIsItself) {
  const Map map = TwoLandmarks();
  const LandmarkId id = map.At(KeyframeId{0}).landmarks[0];
  EXPECT_EQ(Successor(map, map, id), id);
}

TEST(SuccessorOf, ALandmarkThatHasBecomeOneWithAnotherIsThatOne) {
  const Map before = TwoLandmarks();
  Map second = before;
  // Another keyframe sees the first feature's landmark as one of its own, and the two are merged.
  Keyframe keyframe = before.At(KeyframeId{0});
  keyframe.id = {1};
  keyframe.parent = {0};
  keyframe.landmarks.assign(2, LandmarkId{});
  Landmark landmark;
  landmark.position = {0, 0, 5};
  landmark.observations = {{{1}, 1}};
  landmark.created_by = {1};
  MapEdit edit;
  edit.new_keyframes = {keyframe};
  edit.new_landmarks = {landmark};
  second.Apply(edit);
  const LandmarkId gone = second.At(KeyframeId{1}).landmarks[1];
  const LandmarkId kept = second.At(KeyframeId{0}).landmarks[0];
  Map merged = second;
  MapEdit merge;
  merge.merges = {{gone, kept}};
  merged.Apply(merge);
  EXPECT_EQ(Successor(second, merged, gone), kept);
}

TEST(SuccessorOf, ALandmarkThatHasLostWhoSawItIsStillItself) {
  const Map before = TwoLandmarks();
  const LandmarkId id = before.At(KeyframeId{0}).landmarks[0];
  Map now = before;
  Keyframe keyframe = before.At(KeyframeId{0});
  keyframe.id = {1};
  keyframe.parent = {0};
  keyframe.landmarks = {id, {}};
  MapEdit edit;
  edit.new_keyframes = {keyframe};
  edit.cuts = {{id, {{0}, 0}}};
  now.Apply(edit);
  EXPECT_EQ(Successor(before, now, id), id);
}

TEST(SuccessorOf, ALandmarkThatIsGoneHasNone) {
  const Map before = TwoLandmarks();
  const LandmarkId id = before.At(KeyframeId{0}).landmarks[0];
  Map now = before;
  MapEdit edit;
  edit.removed_landmarks = {id};
  now.Apply(edit);
  EXPECT_FALSE(Successor(before, now, id).valid());
  EXPECT_FALSE(Successor(before, {}, id).valid());
  EXPECT_FALSE(Successor({}, before, id).valid());
}

TEST(SuccessorOf, ALandmarkIsNotAnotherOfItsKeyframeThatHasItsId) {
  const Map before = TwoLandmarks();
  // The same two, added where another has taken the first of their slots.
  MapContents contents = before.Contents();
  Map now;
  MapEdit edit;
  Keyframe keyframe = before.At(KeyframeId{0});
  keyframe.landmarks.assign(2, LandmarkId{});
  edit.new_keyframes = {keyframe};
  std::swap(contents.landmarks[0], contents.landmarks[1]);
  edit.new_landmarks = contents.landmarks;
  now.Apply(edit);
  for (const LandmarkId id : before.At(KeyframeId{0}).landmarks) {
    const LandmarkId there = Successor(before, now, id);
    ASSERT_TRUE(there.valid());
    EXPECT_NE(there, id);
    EXPECT_EQ(now.At(there).position, before.At(id).position);
  }
}

Eigen::Isometry3d Moving(double metres, double radians) {
  Eigen::Isometry3d pose(Eigen::AngleAxisd(radians, Eigen::Vector3d::UnitY()));
  pose.translation() << metres, 0, 2 * metres;
  return pose;
}

/// A keyframe seen from `parent`, with a landmark of its own.
MapEdit Child(const Map& map, KeyframeId parent) {
  MapEdit edit;
  Keyframe keyframe = map.At(parent);
  keyframe.id = map.NextKeyframeId();
  keyframe.parent = parent;
  keyframe.T_world_rig = map.At(parent).T_world_rig * Moving(0.2, 0.1);
  keyframe.landmarks.assign(2, LandmarkId{});
  Landmark landmark;
  landmark.position = keyframe.T_world_rig * Eigen::Vector3d(0.5, 0, 4);
  landmark.observations = {{keyframe.id, 0}};
  landmark.created_by = keyframe.id;
  edit.new_keyframes = {keyframe};
  edit.new_landmarks = {landmark};
  return edit;
}

TEST(CarriedOver, AKeyframeAndWhatItHasBroughtGoWithItsParent) {
  Map before = TwoLandmarks();
  before.Apply(Child(before, {0}));
  const MapEdit edit = Child(before, {1});
  Map now = before;
  before.Apply(edit);  // it waits, and shows
  MapEdit closing;
  closing.poses = {{{0}, Moving(-1, 0.02)}, {{1}, Moving(8, 0.3)}};
  now.Apply(closing);
  const MapEdit carried = CarriedOver(edit, before, now);
  const auto expect_standing_as_before = [&](const MapEdit& moved) {
    const Keyframe& keyframe = moved.new_keyframes[0];
    const Eigen::Isometry3d T_parent_rig = now.PoseOf({1}).inverse() * keyframe.T_world_rig;
    EXPECT_TRUE(T_parent_rig.isApprox(Moving(0.2, 0.1), 1e-12));
    EXPECT_TRUE((keyframe.T_world_rig.inverse() * moved.new_landmarks[0].position)
                    .isApprox(Eigen::Vector3d(0.5, 0, 4), 1e-12));
  };
  expect_standing_as_before(carried);
  EXPECT_EQ(carried.new_keyframes[0].parent, KeyframeId{1});
  // The same where the parent is culled besides: its heir carries it.
  MapEdit culling;
  culling.removed_keyframes = {{1}};
  now.Apply(culling);
  const MapEdit inherited = CarriedOver(edit, before, now);
  expect_standing_as_before(inherited);
  EXPECT_EQ(inherited.new_keyframes[0].parent, KeyframeId{0});
}

TEST(CarriedOver, WhatHasNotMovedKeepsItsBits) {
  Map before = TwoLandmarks();
  MapEdit odd;
  odd.poses = {{{0}, Moving(1.0 / 3, 0.7)}};
  before.Apply(odd);
  const MapEdit edit = Child(before, {0});
  Map shown = before;
  shown.Apply(edit);
  const MapEdit carried = CarriedOver(edit, shown, before);
  EXPECT_EQ(carried.new_keyframes[0].T_world_rig.matrix(),
            edit.new_keyframes[0].T_world_rig.matrix());
  EXPECT_EQ(carried.new_landmarks[0].position, edit.new_landmarks[0].position);
}

}  // namespace
}  // namespace aisle::slam
