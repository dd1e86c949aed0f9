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

}  // namespace
}  // namespace aisle::slam
