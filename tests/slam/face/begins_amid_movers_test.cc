#include <gtest/gtest.h>

#include <filesystem>

#include "slam/stereo_slam.h"
#include "tests/slam/dynamic/synthetic_stereo.h"

namespace aisle::slam {
namespace {

constexpr std::int64_t kFrameNs = 50'000'000;
constexpr double kSpeedMps = 1.0;

using Panels = std::vector<test::Panel>;

/// Where the rig is at frame `k`: it goes straight on.
Eigen::Isometry3d PoseAt(int k) {
  Eigen::Isometry3d T_world_rig = Eigen::Isometry3d::Identity();
  T_world_rig.translation().z() = kSpeedMps * 1e-9 * static_cast<double>(k * kFrameNs);
  return T_world_rig;
}

StereoImages See(const Panels& panels, int k) {
  const double seconds = 1e-9 * static_cast<double>(k * kFrameNs);
  const auto view = test::Render(panels, StereoCamera(), PoseAt(k), seconds, 2.0);
  return {k, k * kFrameNs, view.left, view.right};
}

/// The hall, and somebody in it who goes ahead of the rig, as fast, from the first frame on.
Panels BehindALeader(const Eigen::Vector3d& at, double half_width, double half_height) {
  Panels panels = test::StaticHall();
  test::Panel leader = test::Walker(at, {0, 0, kSpeedMps});
  leader.half_width = half_width;
  leader.half_height = half_height;
  leader.contrast = 100;
  leader.brightness = 128;
  panels.push_back(leader);
  return panels;
}

/// How far off the rig is in the end, metres, of 0.7 driven.
double ErrorOf(const SlamOptions& options, const Panels& panels) {
  StereoSlam slam(StereoCamera(), options);
  double error_m = 0;
  for (int k = 0; k < 15; ++k) {
    const TrackedFrame tracked = slam.Track(See(panels, k));
    EXPECT_TRUE(tracked.T_world_rig) << "frame " << k;
    if (!tracked.T_world_rig) continue;
    error_m = (tracked.T_world_rig->translation() - PoseAt(k).translation()).norm();
  }
  return error_m;
}

SlamOptions With(DynamicMethod method) {
  SlamOptions options;
  options.dynamic.method = method;
  return options;
}

TEST(StereoSlam, ADriveThatBeginsBehindSomebodyDoesNotGoAlongWithHim) {
  const Panels panels = BehindALeader({0.1, 0, 1.2}, 0.6, 1.2);  // has most of the corners
  EXPECT_GT(ErrorOf(With(DynamicMethod::kNone), panels), 0.5);
  EXPECT_LT(ErrorOf(With(DynamicMethod::kRobust), panels), 0.02);
}

/// He hides so much that nothing in the images tells him from the world; a map does, of the hall
/// as it was before he came.
TEST(StereoSlam, APriorMapTellsTheWorldFromWhoGoesAlong) {
  const std::string map_file = testing::TempDir() + "hall_without_him.map";
  {
    StereoSlam before(StereoCamera(), {});
    for (int k = 0; k < 15; ++k) before.Track(See(test::StaticHall(), k));
    before.SaveMap(map_file);
  }
  const Panels panels = BehindALeader({0.15, 0, 1.0}, 0.72, 1.4);
  SlamOptions options = With(DynamicMethod::kRobust);
  EXPECT_GT(ErrorOf(options, panels), 0.5);
  options.map_file = map_file;
  options.threads = 1;
  const double error_m = ErrorOf(options, panels);
  EXPECT_LT(error_m, 0.02);
  options.threads = 3;
  EXPECT_EQ(ErrorOf(options, panels), error_m);
  options.localise_only = true;
  EXPECT_LT(ErrorOf(options, panels), 0.02);
  std::filesystem::remove(map_file);
}

}  // namespace
}  // namespace aisle::slam
