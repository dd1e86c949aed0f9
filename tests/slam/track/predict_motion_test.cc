#include "slam/track/predict_motion.h"

#include <gtest/gtest.h>

#include "slam/map/create_landmarks.h"
#include "tests/slam/track/point_world.h"

namespace aisle::slam {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

/// A rig that goes ahead by a metre a second, last seen where its keyframe stands.
TrackMemory Ahead() {
  TrackMemory memory;
  memory.reference = {0};
  memory.motion = EstimateMotion(At(0, 0), At(0, 0.05), 0.05);
  memory.velocity = Velocity{.per_second = memory.motion->per_second};
  return memory;
}

Map MapWithOneKeyframe() {
  Keyframe keyframe;
  keyframe.id = {0};
  keyframe.frame = PointWorld().See(At(0, 3), 0);
  keyframe.T_world_rig = At(0, 3);
  keyframe.landmarks.resize(static_cast<std::size_t>(keyframe.frame->size()));
  MapEdit edit;
  edit.new_landmarks = CreateLandmarks(keyframe, {}, {});
  edit.new_keyframes = {keyframe};
  Map map;
  map.Apply(edit);
  return map;
}

TEST(PredictMotion, GoesOnAsBefore) {
  const auto predicted = PredictMotion(Ahead(), kSecond / 10, {});
  ASSERT_TRUE(predicted);
  EXPECT_TRUE(predicted->T_now_before.isApprox(At(0, 0.1).inverse(), 1e-9));
}

TEST(PredictMotion, KnowsNothingWithoutMotionOrAfterTooLongAGap) {
  const TrackOptions options;
  const auto too_late = static_cast<std::int64_t>(options.longest_gap_s * 1e9) + 1'000;
  EXPECT_FALSE(PredictMotion({}, kSecond / 10, options));
  EXPECT_FALSE(PredictMotion(Ahead(), 0, options));
  EXPECT_FALSE(PredictMotion(Ahead(), too_late, options));
}

TEST(ReckonedPose, IsTheWorldsOriginWithoutAMap) {
  EXPECT_EQ(ReckonedPose({}, Ahead(), kSecond, {}).matrix(), Eigen::Matrix4d::Identity());
}

TEST(ReckonedPose, GoesOnFromTheLastPoseButNoLongerThanAMotionIsTrusted) {
  const Map map = MapWithOneKeyframe();
  const TrackOptions options;
  EXPECT_TRUE(ReckonedPose(map, Ahead(), kSecond / 10, options).isApprox(At(0, 3.1), 1e-9));
  EXPECT_TRUE(ReckonedPose(map, Ahead(), 100 * kSecond, options)
                  .isApprox(At(0, 3 + options.longest_gap_s), 1e-9));
}

}  // namespace
}  // namespace aisle::slam
