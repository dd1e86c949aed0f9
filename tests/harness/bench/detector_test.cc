#include "harness/bench/detector.h"

#include <gtest/gtest.h>

#include "harness/io/input_error.h"

namespace aisle {
namespace {

FrameTruth WithMover(const Eigen::Vector3d& velocity_in_rig) {
  FrameTruth truth;
  truth.T_world_rig.linear() =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.2, 1, -0.4).normalized()).toRotationMatrix();
  ObjectTruth mover;
  mover.instance = 4;
  mover.velocity_mps = truth.T_world_rig.linear() * velocity_in_rig;
  truth.objects = {mover};
  return truth;
}

TEST(GoesAcrossTest, FromThirtyDegreesToTheOpticalAxisOn) {
  EXPECT_TRUE(GoesAcross(WithMover({1, 0, 0}), 4));
  EXPECT_TRUE(GoesAcross(WithMover({0.58, 0, -1}), 4));
  EXPECT_FALSE(GoesAcross(WithMover({0.57, 0, 1}), 4));
  EXPECT_FALSE(GoesAcross(WithMover({0, 0, -1}), 4));
  EXPECT_FALSE(GoesAcross(WithMover({1, 0, 0}), 5)) << "no such mover";
}

TEST(DetectorOutcomeTest, ClipsAddUp) {
  DetectorOutcome one, other;
  one.frames = 2;
  one.large = {.asked = 3, .counted = 1};
  one.stage_ms["dynamic"] = 30;
  one.losses_across["few points"] = 2;
  other.frames = 1;
  other.large = {.asked = 1, .counted = 1};
  other.stage_ms["dynamic"] = 60;
  other.losses_across = {{"few points", 1}, {"found", 1}};
  one += other;
  EXPECT_EQ(one.frames, 3);
  EXPECT_EQ(one.large.asked, 4);
  EXPECT_EQ(one.large.counted, 2);
  EXPECT_DOUBLE_EQ(one.mean_ms(), 30);
  EXPECT_EQ(one.losses_across, (std::map<std::string, int>{{"few points", 3}, {"found", 1}}));
  EXPECT_EQ(DetectorOutcome().mean_ms(), 0);
}

TEST(LoadClipTest, WhatIsNotThereIsRefused) {
  EXPECT_THROW(LoadClip({.text = "nowhere", .path = "/nowhere"}, {}), std::exception);
}

}  // namespace
}  // namespace aisle
