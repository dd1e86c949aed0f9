#include "slam/camera/stereo_camera.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>

namespace aisle::slam {
namespace {

const std::vector<Eigen::Vector3d> kPoints = {
    {0, 0, 1}, {1, -2, 5}, {-3, 0.4, 12}, {0.1, 0.1, 0.3}, {20, 3, 40}};

TEST(StereoCamera, AgreesWithOpenCvInBothCameras) {
  const StereoCamera camera;
  const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  for (const Eigen::Vector3d& point : kPoints) {
    const Eigen::Vector3d uvd = Project(camera, point);
    for (const double offset_m : {0.0, camera.baseline_m}) {
      std::vector<cv::Point2d> pixel;
      cv::projectPoints(std::vector<cv::Point3d>{{point.x(), point.y(), point.z()}},
                        cv::Vec3d(0, 0, 0), cv::Vec3d(-offset_m, 0, 0), K, cv::noArray(), pixel);
      const double disparity = offset_m > 0 ? uvd.z() : 0;
      EXPECT_NEAR(pixel[0].x, uvd.x() - disparity, 1e-9);
      EXPECT_NEAR(pixel[0].y, uvd.y(), 1e-9);
    }
  }
}

TEST(StereoCamera, BackprojectionUndoesProjection) {
  const StereoCamera camera;
  for (const Eigen::Vector3d& point : kPoints) {
    EXPECT_LT((Backproject(camera, Project(camera, point)) - point).norm(), 1e-12 * point.norm());
    EXPECT_NEAR(DepthOf(camera, Project(camera, point).z()), point.z(), 1e-12 * point.z());
  }
}

TEST(StereoCamera, JacobianAgreesWithDifferences) {
  const StereoCamera camera;
  for (const Eigen::Vector3d& point : kPoints) {
    const Eigen::Matrix3d jacobian = ProjectionJacobian(camera, point);
    const double step = 1e-6 * point.z();
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d shift = step * Eigen::Vector3d::Unit(i);
      const Eigen::Vector3d numeric =
          (Project(camera, point + shift) - Project(camera, point - shift)) / (2 * step);
      EXPECT_LT((numeric - jacobian.col(i)).norm(), 1e-5 * jacobian.norm());
    }
  }
}

TEST(StereoCamera, NamesTheFirstBrokenRule) {
  EXPECT_EQ(Validate(StereoCamera{}), "");
  StereoCamera camera;
  camera.baseline_m = 0;
  EXPECT_NE(Validate(camera).find("baseline_m = 0"), std::string::npos);
}

TEST(StereoCamera, EveryLengthMustBeAFiniteNumber) {
  const std::pair<double StereoCamera::*, const char*> lengths[] = {
      {&StereoCamera::fx, "fx = "},
      {&StereoCamera::fy, "fy = "},
      {&StereoCamera::cx, "cx = "},
      {&StereoCamera::cy, "cy = "},
      {&StereoCamera::baseline_m, "baseline_m = "}};
  for (const auto& [length, name] : lengths) {
    for (const double wrong : {std::numeric_limits<double>::infinity(),
                               -std::numeric_limits<double>::infinity(), std::nan("")}) {
      StereoCamera camera;
      camera.*length = wrong;
      EXPECT_NE(Validate(camera).find(fmt::format("{}{}", name, wrong)), std::string::npos)
          << name << wrong;
    }
  }
}

}  // namespace
}  // namespace aisle::slam
