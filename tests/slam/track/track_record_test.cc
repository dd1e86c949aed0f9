#include "slam/track/track_record.h"

#include <gtest/gtest.h>

#include "tests/slam/track/point_world.h"

namespace aisle::slam {
namespace {

constexpr std::int64_t kStepNs = 50'000'000;

MeasuredMotion Forward(double metres) {
  MeasuredMotion motion{Eigen::Isometry3d::Identity(), 1e-6 * Matrix6d::Identity()};
  motion.T_now_before.translation().z() = -metres;
  return motion;
}

/// Of a rig that was found at the origin, and before that a step behind if it `goes_on`.
TrackRecord FoundAtOrigin(bool goes_on) {
  PointWorld world;
  Map map;
  TrackMemory memory;
  BeginAtOrigin(world, &map, &memory);
  FramePose pose = PoseOfKeyframe(map, memory.reference);
  pose.pose.covariance = 1e-6 * Matrix6d::Identity();
  TrackRecord record;
  record.Note(map, *world.See(At(0, 0), 0), pose, false, {});
  if (goes_on) record.Note(map, *world.See(At(0, 0), kStepNs), pose, true, {});
  return record;
}

TEST(TrackRecord, TheFirstStepIsAsTheImagesShowIt) {
  TrackRecord record = FoundAtOrigin(false);
  record.Roll({}, kStepNs, {}, Forward(0.05));
  ASSERT_TRUE(record.memory().carried);
  EXPECT_NEAR(record.memory().carried->T_now_before.translation().z(), -0.05, 1e-12);
  EXPECT_NEAR(record.memory().carried->covariance(2, 2), 2e-6, 1e-12);  // and of the pose before
  record.Roll({}, kStepNs, {});
  EXPECT_FALSE(record.memory().carried);
}

TEST(TrackRecord, ALaterOneIsAsInertiaCarriesIt) {
  TrackRecord record = FoundAtOrigin(true);
  record.Roll({}, 2 * kStepNs, {}, Forward(0.05));
  ASSERT_TRUE(record.memory().carried);
  EXPECT_NEAR(record.memory().carried->T_now_before.translation().z(), 0, 1e-9);
}

TEST(TrackRecord, WhatIsMeasuredNeedsNeither) {
  TrackRecord record = FoundAtOrigin(false);
  record.Roll(Forward(0.04), kStepNs, {}, Forward(0.05));
  EXPECT_FALSE(record.memory().carried);
  ASSERT_TRUE(record.memory().measured);
  EXPECT_NEAR(record.memory().measured->T_now_before.translation().z(), -0.04, 1e-12);
}

}  // namespace
}  // namespace aisle::slam
