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

}  // namespace
}  // namespace aisle::slam
