#include "tests/slam/face/real_sequences.h"

#include <gtest/gtest.h>

namespace aisle::slam {
namespace {

struct Driven {
  std::vector<TrackedFrame> live;
  std::vector<StampedPose> final_track;
  int keyframes = 0;
};

Driven Drive(const RealSequence& sequence, const SlamOptions& options = {}) {
  StereoSlam slam(sequence.camera, options);
  Driven driven;
  for (const StereoImages& images : sequence.frames) {
    driven.live.push_back(slam.Track(images));
    driven.keyframes += driven.live.back().is_keyframe;
  }
  driven.final_track = slam.Finish();
  return driven;
}

TEST(RealSequences, DrivesTheFirstSixtyMetresOfKitti06) {
  if (!HasRealData("kitti")) GTEST_SKIP() << "no KITTI data at " << AISLE_TEST_DATA;
  const RealSequence sequence = LoadKitti06();
  const Driven driven = Drive(sequence);
  for (const TrackedFrame& frame : driven.live) {
    EXPECT_EQ(frame.state, TrackingState::kTracking) << "frame " << frame.id;
  }
  ASSERT_EQ(driven.final_track.size(), sequence.frames.size());

  double path_m = 0;
  for (std::size_t i = 1; i < sequence.truth.size(); ++i) {
    path_m += (sequence.truth[i].translation() - sequence.truth[i - 1].translation()).norm();
  }
  const std::size_t last = sequence.truth.size() - 1;
  const Eigen::Isometry3d truth = sequence.truth.front().inverse() * sequence.truth[last];
  const auto error = [&](const Eigen::Isometry3d& estimate) {
    return (truth.translation() - estimate.translation()).norm();
  };
  const double final_error_m = error(driven.final_track[last].T_world_rig);
  const double live_error_m = error(*driven.live[last].T_world_rig);
  // The truth's first pose is off: it turns left by 0.3 degrees in the first eight frames while the
  // far end of the street shows a turn to the right. Aligned there, the end is 0.45 m aside
  // whatever is estimated, so the length of the drive is asked for more strictly than its end.
  EXPECT_LE(final_error_m, 0.01 * path_m);
  EXPECT_LE(live_error_m, 0.01 * path_m);
  EXPECT_NEAR(driven.final_track[last].T_world_rig.translation().norm(), truth.translation().norm(),
              0.005 * path_m);
}

TEST(RealSequences, StandsStillWhereEurocStandsStill) {
  if (!HasRealData("euroc-v101-still")) GTEST_SKIP() << "no EuRoC data at " << AISLE_TEST_DATA;
  const Driven driven = Drive(LoadEurocStill());
  double worst_m = 0;
  for (const TrackedFrame& frame : driven.live) {
    ASSERT_EQ(frame.state, TrackingState::kTracking) << "frame " << frame.id;
    worst_m = std::max(worst_m, frame.T_world_rig->translation().norm());
  }
  EXPECT_LE(worst_m, 0.003);
  EXPECT_LE(driven.keyframes, 3);
}

}  // namespace
}  // namespace aisle::slam
