#include "slam/track/track_frame.h"

#include <gtest/gtest.h>

#include "slam/track/keyframe_policy.h"
#include "slam/track/relocalise.h"
#include "tests/slam/track/point_world.h"

namespace aisle::slam {
namespace {

class TrackFrameTest : public testing::Test {
 protected:
  void SetUp() override { BeginAtOrigin(world, &map, &memory); }

  PointWorld world;
  Map map;
  TrackMemory memory;
};

TEST_F(TrackFrameTest, FindsTheNextFrame) {
  const Eigen::Isometry3d truth = At(0.03, 0.05, 0.5);
  const auto found = TrackFrame({map, *world.See(truth, 50'000'000), {}, 8, {}}, memory);
  ASSERT_TRUE(found);
  EXPECT_LT(Difference(truth.inverse(), found->pose.T_rig_world).norm(), 1e-4);
  EXPECT_EQ(found->local.reference, memory.reference);
}

TEST_F(TrackFrameTest, FindsAFrameThatMotionDidNotPredict) {
  Vector6d wrong;
  wrong << 20, 0, 0, 0, 3, 0;  // per second
  memory.motion = Motion{wrong};
  const Eigen::Isometry3d truth = At(0.02, 0, 1);
  const auto found = TrackFrame({map, *world.See(truth, 50'000'000), {}, 8, {}}, memory);
  ASSERT_TRUE(found);
  EXPECT_LT(Difference(truth.inverse(), found->pose.T_rig_world).norm(), 1e-4);
}

TEST_F(TrackFrameTest, RecognisesTheReferenceKeyframeFromAfar) {
  const Eigen::Isometry3d truth = At(0.8, 1.0, -12);
  const auto found = TrackFrame({map, *world.See(truth, 50'000'000), {}, 8, {}}, memory);
  ASSERT_TRUE(found);
  EXPECT_LT(Difference(truth.inverse(), found->pose.T_rig_world).norm(), 1e-4);
}

TEST_F(TrackFrameTest, AsksWhatStandsForAReferenceThatIsGone) {
  Keyframe keyframe;
  keyframe.id = map.NextKeyframeId();
  keyframe.parent = memory.reference;
  keyframe.frame = world.See(At(0, 0), 0);
  keyframe.landmarks.resize(static_cast<std::size_t>(keyframe.frame->size()));
  MapEdit edit;
  edit.new_keyframes = {keyframe};
  edit.removed_keyframes = {keyframe.id};
  map.Apply(edit);
  const KeyframeId heir = std::exchange(memory.reference, keyframe.id);
  const Eigen::Isometry3d truth = At(0.8, 1.0, -12);  // too far to follow landmarks to
  const auto frame = world.See(truth, 50'000'000);
  const auto found = TrackFrame({map, *frame, {}, 8, {}}, memory);
  ASSERT_TRUE(found);
  EXPECT_LT(Difference(truth.inverse(), found->pose.T_rig_world).norm(), 1e-4);
  const PlaceIndex none;
  EXPECT_EQ(KeyframesToAsk(map, *frame, memory.reference, {nullptr, none}, 0).front(), heir);
}

TEST_F(TrackFrameTest, IsLostWhereNothingIsKnown) {
  EXPECT_FALSE(TrackFrame({map, *world.See(At(0, 0, 180), 50'000'000), {}, 8, {}}, memory));
  EXPECT_FALSE(TrackFrame({map, *world.See(At(0, 300), 50'000'000), {}, 8, {}}, memory));
}

TEST_F(TrackFrameTest, IsFoundAgainWhereItsMotionHasLed) {
  Vector6d ahead;
  ahead << 0, 0, -0.5, 0, 0, 0;  // of T_rig_world, per second
  const auto two_seconds_later = world.See(At(0.1, 1.1, 1), 2'000'000'000);
  EXPECT_FALSE(FindAgain({map, *two_seconds_later, {}, 8, {}}, memory));
  memory.steady_motion = Motion{ahead};
  const auto found = FindAgain({map, *two_seconds_later, {}, 8, {}}, memory);
  ASSERT_TRUE(found);
  EXPECT_LT(Difference(At(0.1, 1.1, 1).inverse(), found->pose.T_rig_world).norm(), 1e-4);
}

TEST_F(TrackFrameTest, IsNotFoundAgainWhereItsMotionCannotHaveLed) {
  memory.steady_motion = Motion{};
  TrackOptions all_around;
  all_around.dead_reckoning.radius_growth_px_per_s = 200;
  const Eigen::Isometry3d aside = At(0.9, 1.2, 2);
  EXPECT_FALSE(FindAgain({map, *world.See(aside, 2'000'000'000), {}, 8, all_around}, memory));
  EXPECT_TRUE(FindAgain({map, *world.See(aside, 3'900'000'000), {}, 8, all_around}, memory));
  EXPECT_FALSE(FindAgain({map, *world.See(At(0, 0), 60'000'000'000), {}, 8, all_around}, memory));
}

TEST_F(TrackFrameTest, AsksForAKeyframeAfterMotionNotAtRest) {
  const auto at_rest_frame = world.See(At(0, 0.001), 50'000'000);
  const auto at_rest = TrackFrame({map, *at_rest_frame, {}, 8, {}}, memory);
  ASSERT_TRUE(at_rest);
  EXPECT_FALSE(NeedsKeyframe(map, *at_rest_frame, *at_rest, {}, {}));
  const auto turned_frame = world.See(At(0.2, 0.2, 52), 50'000'000);
  const auto turned = TrackFrame({map, *turned_frame, {}, 8, {}}, memory);
  ASSERT_TRUE(turned);
  EXPECT_TRUE(NeedsKeyframe(map, *turned_frame, *turned, {}, {}));
}

/// A landmark that somebody walks in front of would be lost to the map for not being found there.
TEST_F(TrackFrameTest, WhatAMaskHidesIsNotExpected) {
  constexpr int kHidden_px = 300;
  const TrackOptions options;
  const StereoCamera camera;
  const Eigen::Isometry3d truth = At(0, 0.05);
  cv::Mat1b mask(camera.height, camera.width, std::uint8_t{0});
  mask.colRange(0, kHidden_px) = 255;
  const MaskedArea masked(mask, {});
  const auto frame = world.See(truth, 50'000'000, PointWorld::Eye::kLeft, kHidden_px);
  const auto blind = TrackFrame({map, *frame, camera, 8, options}, memory);
  const auto knowing = TrackFrame({map, *frame, camera, 8, options, nullptr, &masked}, memory);
  ASSERT_TRUE(blind && knowing);
  EXPECT_EQ(blind->pose.T_rig_world.matrix(), knowing->pose.T_rig_world.matrix());
  EXPECT_EQ(std::ssize(blind->expected), blind->in_view);
  EXPECT_EQ(knowing->in_view, blind->in_view);
  EXPECT_LT(std::ssize(knowing->expected), 0.8 * knowing->in_view);
  const double disc_px = 3 * std::pow(1.2, 7);
  for (const LandmarkId id : knowing->expected) {
    const double u = Project(camera, truth.inverse() * map.At(id).position).x();
    EXPECT_GT(u, kHidden_px - 1);
  }
  for (const LandmarkId id : blind->expected) {
    const double u = Project(camera, truth.inverse() * map.At(id).position).x();
    const bool kept = std::ranges::count(knowing->expected, id) > 0;
    EXPECT_TRUE(kept || u < kHidden_px + disc_px) << u;
  }
}

/// Only the first `inliers` matches are any more.
void KeepInliers(int inliers, FramePose& found) {
  found.pose.inlier.assign(found.pose.inlier.size(), false);
  std::fill_n(found.pose.inlier.begin(), inliers, true);
  found.pose.inliers = inliers;
}

/// Beside somebody who fills the view all that is seen of the world is far. It is better than to go
/// on with the few landmarks that are left.
TEST_F(TrackFrameTest, FewLandmarksAmongManyStereoPointsAskForAKeyframe) {
  const auto frame = world.See(At(0, 0.2), 50'000'000);
  auto found = TrackFrame({map, *frame, {}, 8, {}}, memory);
  ASSERT_TRUE(found);
  KeyframeOptions options{.first_tracked_share = 0, .few_close = 0, .least_turn_deg = 180};
  options.least_motion = 0.001;
  EXPECT_FALSE(NeedsKeyframe(map, *frame, *found, {}, options));
  KeepInliers(options.few_inliers, *found);
  EXPECT_FALSE(NeedsKeyframe(map, *frame, *found, {}, options));
  KeepInliers(options.few_inliers - 1, *found);
  EXPECT_TRUE(NeedsKeyframe(map, *frame, *found, {}, options));
  options.many_new = frame->size() - options.few_inliers + 1;
  EXPECT_FALSE(NeedsKeyframe(map, *frame, *found, {}, options));
}

/// Who walks on shows what he had hidden while the rig stands.
TEST_F(TrackFrameTest, AtRestAKeyframeIsNeededWhereMostOfTheLastOneIsOutOfSight) {
  const auto frame = world.See(At(0, 0), 50'000'000);
  auto found = TrackFrame({map, *frame, {}, 8, {}}, memory);
  ASSERT_TRUE(found);
  const auto landmarks = static_cast<int>(found->matches.size());
  const auto is_needed = [&](int inliers, const KeyframeOptions& options) {
    KeepInliers(inliers, *found);
    return NeedsKeyframeAtOnce(map, *frame, *found, {}, options);
  };
  const KeyframeOptions options{.few_inliers = landmarks, .many_new = 0};
  EXPECT_TRUE(is_needed(landmarks / 4, options));
  EXPECT_FALSE(is_needed(landmarks / 2, options));
  EXPECT_FALSE(is_needed(options.least_inliers - 1, options));
}

}  // namespace
}  // namespace aisle::slam
