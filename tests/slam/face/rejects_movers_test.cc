#include <gtest/gtest.h>

#include "slam/dynamic/dynamic_detector.h"
#include "slam/stereo_slam.h"
#include "tests/slam/dynamic/synthetic_stereo.h"

namespace aisle::slam {
namespace {

/// A rig drives on while somebody crosses the aisle before it, and how it moved from frame to frame
/// is measured: what the detector expects is then not the system's to say.
struct Drive {
  std::vector<StereoImages> frames;
  MeasuredMotion step;
};

Drive DriveTowardsAWalker() {
  std::vector<test::Panel> panels = test::StaticHall();
  panels.push_back(test::Walker({-0.9, 0.15, 2}, {1.2, 0, 0}));
  Drive drive;
  drive.step.T_now_before.translation().z() = -0.05;
  drive.step.covariance = 1e-6 * Matrix6d::Identity();
  for (int k = 0; k < 8; ++k) {
    Eigen::Isometry3d T_world_rig = Eigen::Isometry3d::Identity();
    T_world_rig.translation().z() = 0.05 * k;
    const auto view = test::Render(panels, test::kHalfCamera, T_world_rig, 0.05 * k, 1.0);
    drive.frames.push_back({k, k * 50'000'000, view.left, view.right});
  }
  return drive;
}

/// What a system sees of the drive that is told its masks by a detector beside it.
TEST(StereoSlam, RejectsWhatItsDetectorRejectsInBothCameras) {
  const Drive drive = DriveTowardsAWalker();
  for (const DynamicMethod method : {DynamicMethod::kPaper, DynamicMethod::kRobust}) {
    SlamOptions options, none;
    options.dynamic.method = method;
    StereoSlam slam(test::kHalfCamera, options), told(test::kHalfCamera, none),
        told_of_one(test::kHalfCamera, none);
    DynamicDetector detector(test::kHalfCamera, options.dynamic);
    int differs = 0;
    for (const StereoImages& images : drive.frames) {
      const std::optional<MeasuredMotion> motion =
          images.id > 0 ? std::optional(drive.step) : std::nullopt;
      const DynamicOutput moving =
          detector.Detect({images.stamp_ns, images.left, images.right, {}, motion});
      const TrackedFrame own = slam.Track(images, {}, motion);
      const TrackedFrame both =
          told.Track(images, {moving.regions.mask, moving.mask_right, {}}, motion);
      const TrackedFrame one = told_of_one.Track(images, {moving.regions.mask, {}, {}}, motion);
      EXPECT_EQ(own.keypoints, both.keypoints) << "frame " << images.id;
      EXPECT_EQ(own.stereo_points, both.stereo_points) << "frame " << images.id;
      differs += one.stereo_points != both.stereo_points;
    }
    EXPECT_GT(differs, 2) << "the right mask makes no difference here";
  }
}

}  // namespace
}  // namespace aisle::slam
