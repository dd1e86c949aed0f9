#include "slam/track/orbslam2_keyframe.h"

#include <gtest/gtest.h>

namespace aisle::slam {
namespace {

constexpr double kClosePx = 20, kFarPx = 5;  // 35 baselines are 435.2 / 35 = 12.4 pixels

/// Features in rows, the first `close` of them near and the others far.
std::shared_ptr<const Frame> FrameOf(int close, int far) {
  auto frame = std::make_shared<Frame>();
  for (int i = 0; i < close + far; ++i) {
    Keypoint keypoint;
    keypoint.pixel = {static_cast<float>(10 + i % 70 * 10), static_cast<float>(10 + i / 70 * 10)};
    frame->features.keypoints.push_back(keypoint);
    frame->features.descriptors.emplace_back();
    frame->measurements.push_back(
        {{keypoint.pixel.x, keypoint.pixel.y, i < close ? kClosePx : kFarPx}, 1, 1});
  }
  frame->grid = FeatureGrid(frame->features.keypoints, {752, 480});
  return frame;
}

MapEdit NextKeyframe(const Map& map, const std::shared_ptr<const Frame>& frame) {
  MapEdit edit;
  Keyframe keyframe;
  keyframe.id = map.NextKeyframeId();
  keyframe.frame = frame;
  if (keyframe.id.value > 0) keyframe.parent = {keyframe.id.value - 1};
  keyframe.landmarks.resize(static_cast<std::size_t>(frame->size()));
  edit.new_keyframes = {keyframe};
  return edit;
}

/// A map of `keyframes` alike, whose first keyframe, the reference, has `confirmed` landmarks that
/// the second sees as well and `unconfirmed` that only it sees.
Map MapOf(int keyframes, int confirmed, int unconfirmed) {
  Map map;
  const auto frame = FrameOf(0, confirmed + unconfirmed);
  for (int k = 0; k < keyframes; ++k) {
    MapEdit edit = NextKeyframe(map, frame);
    for (int i = 0; k == 0 && i < confirmed + unconfirmed; ++i) {
      Landmark landmark;
      landmark.position = {0, 0, 5};
      landmark.observations = {{{0}, i}};
      landmark.created_by = {0};
      edit.new_landmarks.push_back(landmark);
    }
    for (int i = 0; k == 1 && i < confirmed; ++i) {
      edit.links.push_back(
          {map.At(KeyframeId{0}).landmarks[static_cast<std::size_t>(i)], {{1}, i}});
    }
    map.Apply(edit);
  }
  return map;
}

/// A pose that the first `tracked` features of a frame support.
FramePose PoseOf(int tracked) {
  FramePose pose;
  pose.local.reference = {0};
  for (int i = 0; i < tracked; ++i) pose.matches.push_back({LandmarkId{i, 0}, i, 0});
  pose.pose.inlier.assign(pose.matches.size(), true);
  pose.pose.inliers = tracked;
  return pose;
}

/// What the rule says of a frame of far points only.
OrbSlam2Verdict VerdictOn(int inliers, const Map& map, OrbSlam2Drive drive) {
  if (drive.seconds_since_found == 0) drive.seconds_since_found = 10;
  return OrbSlam2NeedsKeyframe(map, *FrameOf(0, 400), PoseOf(inliers), {}, drive, {});
}

TEST(OrbSlam2Keyframe, IsTakenBelowThreeQuartersOfTheReference) {
  const Map map = MapOf(3, 100, 0);
  EXPECT_TRUE(VerdictOn(74, map, {}).taken);
  EXPECT_FALSE(VerdictOn(75, map, {}).wanted);
}

TEST(OrbSlam2Keyframe, TheFirstKeyframeAsksForLess) {
  const Map map = MapOf(1, 100, 0);
  EXPECT_TRUE(VerdictOn(39, map, {}).taken);
  EXPECT_FALSE(VerdictOn(40, map, {}).wanted);
}

TEST(OrbSlam2Keyframe, OnlyConfirmedPointsOfTheReferenceCountOnceThereAreThreeKeyframes) {
  EXPECT_FALSE(VerdictOn(80, MapOf(3, 100, 100), {}).wanted);
  EXPECT_TRUE(VerdictOn(80, MapOf(2, 100, 100), {}).wanted);
}

TEST(OrbSlam2Keyframe, NeedsMoreThanFifteenInliers) {
  const Map map = MapOf(3, 100, 0);
  EXPECT_TRUE(VerdictOn(16, map, {}).taken);
  EXPECT_FALSE(VerdictOn(15, map, {}).wanted);
}

TEST(OrbSlam2Keyframe, IsTakenWhereClosePointsLackThoughNothingElseDoes) {
  const Map map = MapOf(3, 50, 0);
  const auto taken = [&](int tracked, int untracked) {
    return OrbSlam2NeedsKeyframe(map, *FrameOf(tracked + untracked, 0), PoseOf(tracked), {},
                                 {.seconds_since_found = 10}, {})
        .taken;
  };
  EXPECT_TRUE(taken(99, 71));
  EXPECT_FALSE(taken(100, 71));
  EXPECT_FALSE(taken(99, 70));
}

TEST(OrbSlam2Keyframe, WhileTheMapperWorksOnlyUrgencyOrASecondBringsOne) {
  const Map map = MapOf(3, 200, 0);
  EXPECT_FALSE(VerdictOn(100, map, {.mapper_idle = false}).wanted);
  EXPECT_TRUE(VerdictOn(49, map, {.mapper_idle = false}).taken);  // below a quarter
  EXPECT_FALSE(VerdictOn(50, map, {.mapper_idle = false}).wanted);
  EXPECT_FALSE(VerdictOn(100, map, {.seconds_since_keyframe = 0.95, .mapper_idle = false}).wanted);
  EXPECT_TRUE(VerdictOn(100, map, {.seconds_since_keyframe = 1, .mapper_idle = false}).taken);
}

TEST(OrbSlam2Keyframe, OfThoseThatWaitThereAreThreeAtMost) {
  const Map map = MapOf(3, 200, 0);
  EXPECT_TRUE(VerdictOn(40, map, {.mapper_idle = false, .waiting = 2}).taken);
  const OrbSlam2Verdict full = VerdictOn(40, map, {.mapper_idle = false, .waiting = 3});
  EXPECT_FALSE(full.taken);
  EXPECT_TRUE(full.wanted);
}

TEST(OrbSlam2Keyframe, NoneIsTakenSoonAfterALossInALargeMap) {
  EXPECT_FALSE(VerdictOn(40, MapOf(21, 200, 0), {.seconds_since_found = 0.9}).wanted);
  EXPECT_TRUE(VerdictOn(40, MapOf(21, 200, 0), {.seconds_since_found = 1}).taken);
  EXPECT_TRUE(VerdictOn(40, MapOf(20, 200, 0), {.seconds_since_found = 0.9}).taken);
}

/// How many landmarks the keyframe of a frame brings, of which `tracked` features have one.
std::size_t NewLandmarks(int close, int far, int tracked) {
  const Map map = MapOf(3, tracked, 0);
  return OrbSlam2Keyframe(map, FrameOf(close, far), PoseOf(tracked), {}, {}).new_landmarks.size();
}

TEST(OrbSlam2Keyframe, MakesLandmarksOfAllClosePointsThatHaveNone) {
  // Published: the first far point after them comes along.
  EXPECT_EQ(NewLandmarks(150, 100, 40), 111u);
  EXPECT_EQ(NewLandmarks(150, 0, 150), 0u);
}

TEST(OrbSlam2Keyframe, SeesToAHundredPointsHoweverFar) {
  EXPECT_EQ(NewLandmarks(30, 300, 0), 101u);
  EXPECT_EQ(NewLandmarks(30, 300, 30), 71u);
  EXPECT_EQ(NewLandmarks(30, 20, 0), 50u);
}

TEST(OrbSlam2Keyframe, SeesTheInliersOfItsPoseAndNoOthers) {
  const Map map = MapOf(3, 60, 0);
  FramePose pose = PoseOf(60);
  pose.pose.inlier[7] = false;
  const MapEdit edit = OrbSlam2Keyframe(map, FrameOf(0, 60), pose, {}, {});
  const std::vector<LandmarkId>& landmarks = edit.new_keyframes.front().landmarks;
  EXPECT_TRUE(landmarks[6].valid());
  EXPECT_FALSE(landmarks[7].valid());
}

TEST(OrbSlam2Keyframe, TheFirstOneNeedsMoreThanFiveHundredFeaturesAndTakesAllWithDepth) {
  EXPECT_FALSE(OrbSlam2FirstKeyframe(FrameOf(100, 400), {}, {}));
  const auto first = OrbSlam2FirstKeyframe(FrameOf(100, 401), {}, {});
  ASSERT_TRUE(first);
  EXPECT_EQ(first->new_landmarks.size(), 501u);
}

}  // namespace
}  // namespace aisle::slam
