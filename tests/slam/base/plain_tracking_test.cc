#include "slam/base/plain_tracking.h"

#include <gtest/gtest.h>

#include "tests/slam/track/point_world.h"

namespace aisle::slam {
namespace {

/// A map of one keyframe at the origin, and a rig that was found there.
class PlainTrackingTest : public testing::Test {
 protected:
  void SetUp() override { BeginAtOrigin(world, &map, &memory); }

  DriveState Drive() const { return {map, memory, {nullptr, index}, 1, false}; }

  PointWorld world;
  Map map;
  PlaceIndex index;
  TrackMemory memory;
  PlainTracking policy{{}, {}};
};

/// The rig's frame and pose half a metre on, where it finds again `inliers` landmarks.
struct Seen {
  std::shared_ptr<const Frame> frame;
  FramePose pose;
};
Seen SeeHalfAMetreOn(const PointWorld& world, const Map& map, KeyframeId reference, int inliers) {
  Seen seen{world.See(At(0.5, 1), 50'000'000), PoseOfKeyframe(map, reference)};
  seen.pose.pose.T_rig_world = At(0.5, 1).inverse();
  seen.pose.matches.resize(static_cast<std::size_t>(inliers));
  seen.pose.pose.inlier.resize(seen.pose.matches.size());
  seen.pose.pose.inliers = inliers;
  return seen;
}

TEST_F(PlainTrackingTest, NoKeyframeIsMadeWhileAnotherIsWorkedIn) {
  SlamOptions options;
  options.keyframe.few_inliers = 0;  // none is needed at once
  const PlainTracking patient{{}, options};
  const Seen seen = SeeHalfAMetreOn(world, map, memory.reference, 40);
  const KeyframeVerdict idle = patient.NeedsKeyframe(map, *seen.frame, seen.pose, {});
  EXPECT_TRUE(idle.taken);
  EXPECT_FALSE(idle.hurry);
  const KeyframeVerdict busy = patient.NeedsKeyframe(map, *seen.frame, seen.pose, {.idle = false});
  EXPECT_FALSE(busy.taken);
  EXPECT_FALSE(busy.hurry);  // it waits for the appointed frame
}

/// Somebody steps into the view: the next frame may see nothing of the map.
TEST_F(PlainTrackingTest, AKeyframeThatIsNeededAtOnceWaitsInTheMap) {
  const Seen seen = SeeHalfAMetreOn(world, map, memory.reference, 40);
  const auto taken = [&](const MapperState& mapper) {
    return policy.NeedsKeyframe(map, *seen.frame, seen.pose, mapper).taken;
  };
  EXPECT_TRUE(taken({.idle = false}));
  EXPECT_FALSE(taken({.idle = false, .closing = true}));
  EXPECT_FALSE(taken({.idle = false, .waiting = 1}));
}

TEST_F(PlainTrackingTest, AFrameWhoseWayIsMeasuredIsLookedForThereThoughNotLost) {
  const Eigen::Isometry3d truth = At(0.03, 0.4);
  const auto frame = world.See(truth, 50'000'000);
  memory.measured = MeasuredMotion{truth.inverse(), 1e-6 * Matrix6d::Identity()};
  const auto found = policy.Find(frame, Drive());
  ASSERT_TRUE(found);
  EXPECT_LT(Difference(truth.inverse(), found->pose.T_rig_world).norm(), 1e-3);
  // Elsewhere the same images are those of something that moves.
  memory.measured = MeasuredMotion{At(0.03, 1.4).inverse(), 1e-6 * Matrix6d::Identity()};
  EXPECT_FALSE(policy.Find(frame, Drive()));
}

TEST_F(PlainTrackingTest, TheMapGoesOnWhereTheRigIsMeasuredToBe) {
  const Eigen::Isometry3d truth = At(40, 3, 90);  // of which the map shows nothing
  memory.T_reference_rig = At(0, 1);
  memory.measured = MeasuredMotion{truth.inverse() * At(0, 1), 1e-6 * Matrix6d::Identity()};
  const auto edit = policy.Extend(world.See(At(0, 0), 50'000'000), Drive());
  ASSERT_TRUE(edit);
  ASSERT_EQ(edit->new_keyframes.size(), 1U);
  const Keyframe& keyframe = edit->new_keyframes[0];
  EXPECT_TRUE(keyframe.T_world_rig.isApprox(truth, 1e-9));
  EXPECT_EQ(keyframe.parent, memory.reference);
  EXPECT_EQ(keyframe.id, map.NextKeyframeId());
  for (const Landmark& landmark : edit->new_landmarks) {
    EXPECT_GT((truth.inverse() * landmark.position).z(), 0);
  }
  EXPECT_FALSE(policy.Extend(std::make_shared<Frame>(), Drive()));  // shows nothing
}

}  // namespace
}  // namespace aisle::slam
