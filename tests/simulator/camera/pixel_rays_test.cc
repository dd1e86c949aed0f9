#include "simulator/camera/pixel_rays.h"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>

namespace aisle::sim {
namespace {

std::vector<cv::Point2d> ProjectByOpenCv(const StereoCamera& camera, const Eigen::Vector3d& point) {
  const cv::Matx33d k(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  std::vector<cv::Point2d> pixels;
  const std::vector<cv::Point3d> points = {{point.x(), point.y(), point.z()}};
  cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), k, cv::noArray(), pixels);
  return pixels;
}

TEST(PixelRays, PointOnARayProjectsToItsPixelInOpenCv) {
  const StereoCamera camera;
  const PixelRays rays = MakePixelRays(camera);
  for (int v = 0; v < camera.height; v += 37) {
    for (int u = 0; u < camera.width; u += 41) {
      const std::size_t i = static_cast<std::size_t>(v * camera.width + u);
      const Eigen::Vector3d point(rays.x[i] * 7.5, rays.y[i] * 7.5, 7.5);
      const cv::Point2d pixel = ProjectByOpenCv(camera, point).front();
      EXPECT_NEAR(pixel.x, u, 1e-4);
      EXPECT_NEAR(pixel.y, v, 1e-4);
    }
  }
}

TEST(PixelRays, AStepLeadsToTheNextPixelThroughAnyLens) {
  for (const Lens& lens : {Lens{}, Lens{LensModel::kRadialTangential, {-0.28, 0.074, 2e-4, 2e-5}},
                           Lens{LensModel::kEquidistant, {-0.01, 0.02, -0.01, 0.002}}}) {
    const PixelRays rays = MakePixelRays({.lens = lens});
    for (const int v : {0, 100, 300, 478}) {
      for (const int u : {0, 150, 400, 750}) {
        const PixelRays::Step step = rays.StepAt(u, v);
        EXPECT_LT((rays.At(u + 1, v) - rays.At(u, v) - step.right).norm(), 1e-6f) << u << ", " << v;
        EXPECT_LT((rays.At(u, v + 1) - rays.At(u, v) - step.down).norm(), 1e-6f) << u << ", " << v;
      }
    }
  }
}

TEST(CameraPose, RightCameraStandsOneBaselineAlongTheRigsX) {
  StereoCamera camera;
  camera.baseline_m = 0.25;
  const Eigen::Isometry3d rig =
      Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized());
  const Eigen::Isometry3d right = CameraPose(camera, rig, StereoSide::kRight);
  EXPECT_TRUE((rig.inverse() * right.translation()).isApprox(Eigen::Vector3d(0.25, 0, 0), 1e-12));
  EXPECT_TRUE(right.linear().isApprox(rig.linear(), 1e-12));
  EXPECT_TRUE(CameraPose(camera, rig, StereoSide::kLeft).isApprox(rig));
}

}  // namespace
}  // namespace aisle::sim
