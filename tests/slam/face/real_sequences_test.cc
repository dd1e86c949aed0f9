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
  std::map<std::string, double> total_ms;
  for (const StereoImages& images : sequence.frames) {
    driven.live.push_back(slam.Track(images));
    driven.keyframes += driven.live.back().is_keyframe;
    for (const auto& [stage, ms] : driven.live.back().stage_ms) total_ms[stage] += ms;
    if (std::getenv("AISLE_TALK")) {
      const TrackedFrame& f = driven.live.back();
      fmt::print("{:3d} state {} features {} stereo {} matched {} inliers {} kf {}\n", f.id,
                 static_cast<int>(f.state), f.features, f.stereo_points, f.matched_points,
                 f.inliers, f.is_keyframe);
    }
  }
  driven.final_track = slam.Finish();
  if (std::getenv("AISLE_TALK")) {
    for (const auto& [stage, ms] : total_ms) {
      fmt::print("{} {:.2f} ms a frame\n", stage, ms / static_cast<double>(driven.live.size()));
    }
  }
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
  RecordProperty("final_error_m", std::to_string(final_error_m));
  fmt::print("KITTI 06: {:.2f} m, end error {:.3f} m final, {:.3f} m live, {} keyframes\n", path_m,
             final_error_m, live_error_m, driven.keyframes);
  EXPECT_LE(final_error_m, 0.005 * path_m);
  EXPECT_LE(live_error_m, 0.005 * path_m);
}

TEST(RealSequences, StandsStillWhereEurocStandsStill) {
  if (!HasRealData("euroc-v101-still")) GTEST_SKIP() << "no EuRoC data at " << AISLE_TEST_DATA;
  const Driven driven = Drive(LoadEurocStill());
  double worst_m = 0;
  for (const TrackedFrame& frame : driven.live) {
    ASSERT_EQ(frame.state, TrackingState::kTracking) << "frame " << frame.id;
    worst_m = std::max(worst_m, frame.T_world_rig->translation().norm());
  }
  fmt::print("EuRoC still: worst drift {:.2f} mm, {} keyframes\n", 1e3 * worst_m, driven.keyframes);
  EXPECT_LE(worst_m, 0.003);
  EXPECT_LE(driven.keyframes, 3);
}

}  // namespace
}  // namespace aisle::slam
