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

/// Seen driving ahead by a metre a second for a second, then not for another, in which it went less
/// far than inertia thought.
class FoundAfterCoasting : public testing::Test {
 protected:
  void SetUp() override {
    options.inertia.acceleration_mps2 = 1.5;  // it may have braked so much
    TrackMemory memory;
    BeginAtOrigin(world, &map, &memory);
    for (int k = 0; k < 20; ++k) Find(0.05 * k, k);
  }
  void Find(double ahead_m, int frame) {
    FramePose pose = PoseOfKeyframe(map, map.keyframes().begin()->first);
    pose.pose.T_rig_world = At(0, ahead_m).inverse();
    pose.pose.covariance = 1e-6 * Matrix6d::Identity();
    record.Note(map, *world.See(At(0, ahead_m), frame * kStepNs), pose, frame > 0, options);
  }
  void Coast(const std::optional<MeasuredMotion>& measured) {
    for (int k = 20; k < 39; ++k) {
      record.Roll(measured, k * kStepNs, options.inertia);
      record.Coast(map, k * kStepNs, options.inertia);
    }
    record.Roll(measured, 39 * kStepNs, options.inertia);
  }
  static double Ahead(const std::optional<Motion>& motion) { return -motion->per_second.z(); }

  TrackOptions options;
  PointWorld world;
  Map map;
  TrackRecord record;
};

TEST_F(FoundAfterCoasting, TheErrorOfInertiaIsNoMotion) {
  Coast({});
  Find(0.05 * 39 - 0.25, 39);  // at 0.74 m/s
  ASSERT_TRUE(record.memory().motion);
  EXPECT_GT(Ahead(record.memory().motion), 0.4);
  EXPECT_LT(Ahead(record.memory().motion), 1);
  EXPECT_GT(Ahead(record.memory().steady_motion), 0.7);
  Find(0.05 * 39 - 0.25 + 0.037, 40);  // from here on steps are seen again
  EXPECT_NEAR(Ahead(record.memory().motion), 0.74, 1e-6);
}

TEST_F(FoundAfterCoasting, WhatIsMeasuredIs) {
  Coast(Forward(0.04));
  Find(0.05 * 19 + 20 * 0.04 + 0.1, 39);
  EXPECT_NEAR(Ahead(record.memory().motion), 0.8, 1e-9);
}

TEST_F(FoundAfterCoasting, WhatIsMeasuredTeachesTheVelocity) {
  Coast(Forward(0.03));  // braked to 0.6 m/s where nobody saw it
  record.Coast(map, 39 * kStepNs, {});
  record.Roll({}, 40 * kStepNs, {});
  ASSERT_TRUE(record.memory().carried);
  EXPECT_NEAR(record.memory().carried->T_now_before.translation().z(), -0.03, 1e-3);
}

/// Wheels that say nothing of one step: inertia bridges it, and what they say then counts from
/// there.
TEST_F(FoundAfterCoasting, OneGapInWhatIsMeasuredIsOneStepOfInertia) {
  Coast(Forward(0.05));
  record.Coast(map, 39 * kStepNs, {});
  record.Roll({}, 40 * kStepNs, {});
  EXPECT_FALSE(record.memory().measured);
  ASSERT_TRUE(record.memory().carried);
  record.Coast(map, 40 * kStepNs, {});
  const Matrix6d known = record.memory().covariance;
  record.Roll(Forward(0.05), 41 * kStepNs, {});
  ASSERT_TRUE(record.memory().measured);
  EXPECT_FALSE(record.memory().carried);
  EXPECT_NEAR(record.memory().measured->T_now_before.translation().z(), -0.05, 1e-12);
  EXPECT_GT(record.memory().measured->covariance(2, 2), known(2, 2));
}

/// Where the step before was not even guessed, a measured one leads nowhere.
TEST_F(FoundAfterCoasting, AStepFromAnUnknownPlaceLeadsNowhere) {
  record.Roll({}, 20 * kStepNs, {});
  record.Roll(Forward(0.05), 21 * kStepNs, {});
  EXPECT_FALSE(record.memory().measured);
}

/// A rig that waits behind a person does not learn at every frame that what the person hides is
/// not found: a landmark would be lost to the map for having been stood in front of.
TEST(TrackRecord, FromOnePlaceALandmarkIsLookedForOnce) {
  PointWorld world;
  Map map;
  TrackMemory memory;
  BeginAtOrigin(world, &map, &memory);
  FramePose pose = PoseOfKeyframe(map, memory.reference);
  pose.expected = {pose.matches[0].landmark, pose.matches[1].landmark};
  pose.pose.inlier[1] = false;  // hidden
  const LookOptions published{0, 0};
  for (const LookOptions& options : {LookOptions(), published}) {
    TrackRecord record;
    for (int k = 0; k < 10; ++k) {
      pose.pose.T_rig_world = At(0, 0.001 * (k % 2)).inverse();  // as noise moves it
      record.Count(pose, options);
    }
    pose.pose.T_rig_world = At(0, 0.05).inverse();
    record.Count(pose, options);
    pose.pose.T_rig_world =
        (At(0, 0.05) * Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitY())).inverse();
    record.Count(pose, options);
    const int looks = options.least_m > 0 ? 3 : 12;
    for (const MapEdit::Count& count : record.TakeCounts()) {
      if (count.landmark == pose.expected[0] || count.landmark == pose.expected[1]) {
        EXPECT_EQ(count.predicted, looks);
      }
      EXPECT_EQ(count.found, count.landmark == pose.expected[1] ? 0 : looks);
    }
  }
}

/// Inertia is no witness of itself.
TEST(TrackRecord, TheVelocityLearnsFromWhatTheImagesAloneTell) {
  PointWorld world;
  Map map;
  TrackMemory memory;
  BeginAtOrigin(world, &map, &memory);
  FramePose pose = PoseOfKeyframe(map, memory.reference);
  pose.pose.covariance = 1e-6 * Matrix6d::Identity();
  TrackRecord record;
  record.Note(map, *world.See(At(0, 0), 0), pose, false, {});
  pose.seen = pose.pose;
  pose.seen->T_rig_world = At(0, 0.05).inverse();
  pose.seen->covariance = 4e-6 * Matrix6d::Identity();
  pose.pose.T_rig_world = At(0, 0.04).inverse();
  record.Note(map, *world.See(At(0, 0.05), kStepNs), pose, true, {});
  ASSERT_TRUE(record.memory().velocity);
  EXPECT_NEAR(record.memory().velocity->per_second.z(), -0.05 / 0.05, 1e-9);
  EXPECT_NEAR(record.memory().velocity->covariance(2, 2), 5e-6 / (0.05 * 0.05), 1e-9);
  EXPECT_NEAR(record.memory().PoseIn(map).translation().z(), 0.04, 1e-12);
  EXPECT_NEAR(record.memory().covariance(2, 2), 1e-6, 1e-12);
}

TEST(TrackRecord, AForgottenMotionIsForgottenByAll) {
  TrackRecord record = FoundAtOrigin(true);
  record.ForgetMotion();
  EXPECT_FALSE(record.memory().motion);
  record.Roll(Forward(0.05), 2 * kStepNs, {});
  EXPECT_FALSE(record.memory().measured);
  EXPECT_FALSE(record.memory().carried);
}

}  // namespace
}  // namespace aisle::slam
