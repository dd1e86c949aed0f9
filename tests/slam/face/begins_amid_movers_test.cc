#include <gtest/gtest.h>

#include "slam/stereo_slam.h"
#include "tests/slam/dynamic/synthetic_stereo.h"

namespace aisle::slam {
namespace {

constexpr std::int64_t kFrameNs = 50'000'000;
constexpr double kSpeedMps = 1.0;

/// How far off the rig is in the end, metres, of 0.7 driven. It goes through the hall behind
/// somebody who goes as fast and has most of the corners that it sees, from the first frame on.
double ErrorBehindALeader(DynamicMethod method) {
  auto panels = test::StaticHall();
  test::Panel leader = test::Walker({0.1, 0, 1.2}, {0, 0, kSpeedMps});
  leader.half_width = 0.6;
  leader.half_height = 1.2;
  leader.contrast = 100;
  leader.brightness = 128;
  panels.push_back(leader);
  SlamOptions options;
  options.dynamic.method = method;
  const StereoCamera camera;
  StereoSlam slam(camera, options);
  double error_m = 0;
  for (int k = 0; k < 15; ++k) {
    const double seconds = 1e-9 * static_cast<double>(k * kFrameNs);
    Eigen::Isometry3d T_world_rig = Eigen::Isometry3d::Identity();
    T_world_rig.translation().z() = kSpeedMps * seconds;
    const auto view = test::Render(panels, camera, T_world_rig, seconds, 2.0);
    const TrackedFrame tracked = slam.Track({k, k * kFrameNs, view.left, view.right});
    EXPECT_TRUE(tracked.T_world_rig) << "frame " << k;
    if (tracked.T_world_rig) {
      error_m = (tracked.T_world_rig->translation() - T_world_rig.translation()).norm();
    }
  }
  return error_m;
}

TEST(StereoSlam, ADriveThatBeginsBehindSomebodyDoesNotGoAlongWithHim) {
  EXPECT_GT(ErrorBehindALeader(DynamicMethod::kNone), 0.5);
  EXPECT_LT(ErrorBehindALeader(DynamicMethod::kRobust), 0.02);
}

}  // namespace
}  // namespace aisle::slam
