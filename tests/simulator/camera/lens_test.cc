// The simulator's lens against OpenCV's two, which share no code with it.
#include "simulator/camera/lens.h"

#include <gmock/gmock.h>

#include <limits>
#include <numbers>
#include <opencv2/calib3d.hpp>

#include "simulator/camera/pixel_rays.h"

namespace aisle::sim {
namespace {

StereoCamera WithLens(LensModel model, const std::array<double, 4>& coefficients) {
  StereoCamera camera;
  camera.lens = {model, coefficients};
  return camera;
}

/// EuRoC's left camera, a mild and a strong barrel, a pincushion; fisheyes.
std::vector<StereoCamera> Cameras() {
  using enum LensModel;
  std::vector<StereoCamera> cameras = {
      WithLens(kPinhole, {}),
      WithLens(kRadialTangential, {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05}),
      WithLens(kRadialTangential, {-0.1, 0.01, -0.002, 0.003}),
      WithLens(kRadialTangential, {0.2, 0.05, 0.001, -0.001}),
      WithLens(kEquidistant, {0, 0, 0, 0}),
      WithLens(kEquidistant, {-0.013, 0.02, -0.012, 0.0025})};
  cameras[1].fx = 458.654;
  cameras[1].fy = 457.296;
  cameras[1].cx = 367.215;
  cameras[1].cy = 248.375;
  return cameras;
}

cv::Point2d ProjectByOpenCv(const StereoCamera& camera, const Eigen::Vector3d& point) {
  const cv::Matx33d k(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  const auto& c = camera.lens.coefficients;
  const cv::Vec4d d(c[0], c[1], c[2], c[3]);
  const std::vector<cv::Point3d> points = {{point.x(), point.y(), point.z()}};
  std::vector<cv::Point2d> pixels;
  if (camera.lens.model == LensModel::kEquidistant) {
    cv::fisheye::projectPoints(points, pixels, cv::Vec3d(), cv::Vec3d(), k, d);
  } else {
    cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), k, d, pixels);
  }
  return pixels.front();
}

TEST(Lens, APixelsRayProjectsBackToThePixelInOpenCv) {
  for (const StereoCamera& camera : Cameras()) {
    const PixelRays rays = MakePixelRays(camera);
    for (int v = 0; v < camera.height; v += 37) {
      for (int u = 0; u < camera.width; u += 41) {
        const Eigen::Vector2d ray = rays.At(u, v).cast<double>();
        const cv::Point2d pixel = ProjectByOpenCv(camera, 7.5 * ray.homogeneous());
        EXPECT_NEAR(pixel.x, u, 1e-4);
        EXPECT_NEAR(pixel.y, v, 1e-4);
      }
    }
  }
}

TEST(Lens, ProjectIsOpenCvsProjection) {
  for (const StereoCamera& camera : Cameras()) {
    for (const Eigen::Vector3d& point :
         {Eigen::Vector3d(0, 0, 3), Eigen::Vector3d(0.5, -0.3, 1), Eigen::Vector3d(-2.4, 1.3, 4)}) {
      const cv::Point2d expected = ProjectByOpenCv(camera, point);
      const auto pixel = Projection(camera)(point);
      ASSERT_TRUE(pixel.has_value());
      EXPECT_NEAR(pixel->x(), expected.x, 1e-9);
      EXPECT_NEAR(pixel->y(), expected.y, 1e-9);
    }
  }
}

TEST(Lens, UndistortInvertsDistort) {
  for (const StereoCamera& camera : Cameras()) {
    for (double x = -0.8; x < 0.85; x += 0.1) {
      for (double y = -0.6; y < 0.65; y += 0.1) {
        const auto image = Distort(camera.lens, WidestRay(camera.lens), {x, y});
        ASSERT_TRUE(image.has_value());
        const auto back = Undistort(camera.lens, WidestRay(camera.lens), *image);
        ASSERT_TRUE(back.has_value());
        EXPECT_LT((*back - Eigen::Vector2d(x, y)).norm(), 1e-10);
      }
    }
  }
}

TEST(Lens, BeyondItsFoldItHasNoRay) {
  // x(1 - 0.5 x²) is largest, 0.544, at x = 0.816.
  const Lens lens{LensModel::kRadialTangential, {-0.5, 0, 0, 0}};
  EXPECT_TRUE(Undistort(lens, WidestRay(lens), {0.53, 0}).has_value());
  EXPECT_FALSE(Undistort(lens, WidestRay(lens), {0.56, 0}).has_value());
  const Lens fisheye{LensModel::kEquidistant, {}};
  EXPECT_FALSE(Undistort(fisheye, WidestRay(fisheye), {1.55, 0}).has_value());
  try {
    MakePixelRays(WithLens(LensModel::kRadialTangential, {-0.5, 0, 0, 0}));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("no ray for pixel (0, 0)"));
  }
}

TEST(Lens, AFisheyeHasEveryRayUpToItsFold) {
  for (const Lens& lens : {Lens{LensModel::kEquidistant, {0.0979, 0.0091, -0.0124, -0.0096}},
                           Lens{LensModel::kEquidistant, {0.05, -0.04, -0.02, 0}},
                           Lens{LensModel::kEquidistant, {-0.1, 0, 0, 0}},
                           Lens{LensModel::kEquidistant, {0, 0, 0, 0}}}) {
    const double widest = WidestRay(lens), fold = std::atan(widest);
    for (double angle = 0.01; angle < fold - 2e-3; angle += 0.01) {
      const double ray = std::tan(angle);
      const auto image = Distort(lens, widest, {ray, 0});
      ASSERT_TRUE(image.has_value()) << angle;
      const auto back = Undistort(lens, widest, *image);
      ASSERT_TRUE(back.has_value()) << angle << " of " << fold;
      EXPECT_NEAR(std::atan(back->x()), angle, 1e-7);
    }
  }
}

TEST(Lens, WhatIsBeyondItsFoldDoesNotAppear) {
  using enum LensModel;
  // One that folds for good, one that folds and unfolds again, one that never does, two by angle.
  for (const Lens& lens :
       {Lens{kRadialTangential, {-0.3, 0, 0, 0}}, Lens{kRadialTangential, {-0.5, 0.06, 0, 0}},
        Lens{kRadialTangential, {-0.283, 0.074, 0.0002, 0.00002}},
        Lens{kEquidistant, {-0.4, 0, 0, 0}}, Lens{kEquidistant, {0, 0, 0, 0}}}) {
    const double widest = WidestRay(lens);
    double before = 0;
    bool rises = true;
    for (double r = 0.01; r < 11; r += 0.01) {
      const auto image = Distort(lens, std::numeric_limits<double>::infinity(), {r, 0});
      rises = rises && image && image->x() > before;
      if (image) before = image->x();
      const bool within =
          lens.model == kRadialTangential || r < std::tan(85 * std::numbers::pi / 180);
      if (std::abs(r - widest) < 0.02) continue;
      EXPECT_EQ(Distort(lens, widest, {r, 0}).has_value(), rises && within) << r;
    }
  }
}

TEST(WindowOfRays, HoldsAllRaysOfTheBoxAndBarelyMore) {
  for (const StereoCamera& camera : Cameras()) {
    const PixelRays rays = MakePixelRays(camera);
    const Eigen::Vector2d low(-0.21, 0.05), high(0.33, 0.4);
    const PixelWindow window = WindowOfRays(rays, low, high);
    int inside = 0;
    for (int y = 0; y < rays.height; ++y) {
      for (int x = 0; x < rays.width; ++x) {
        const Eigen::Vector2d ray = rays.At(x, y).cast<double>();
        if ((ray.array() < low.array() + 1e-6).any() || (ray.array() > high.array() - 1e-6).any()) {
          continue;
        }
        ++inside;
        EXPECT_TRUE(x >= window.x0 && x < window.x1 && y >= window.y0 && y < window.y1);
      }
    }
    EXPECT_GT(inside, 0.8 * (window.x1 - window.x0) * (window.y1 - window.y0));
  }
}

TEST(Coarser, LooksAtTheSameView) {
  const StereoCamera camera;
  const PixelRays fine = MakePixelRays(camera), coarse = MakePixelRays(Coarser(camera, 8));
  // A coarse pixel's centre is the middle of its 8 × 8 fine ones.
  const Eigen::Vector2f middle = (fine.At(83, 43) + fine.At(84, 44)) / 2;
  EXPECT_LT((coarse.At(10, 5) - middle).norm(), 1e-6f);
}

TEST(RowsOf, AreTheSameRays) {
  const PixelRays rays = MakePixelRays(StereoCamera());
  const PixelRays band = RowsOf(rays, 100, 130);
  EXPECT_EQ(band.height, 30);
  EXPECT_EQ(band.At(77, 3), rays.At(77, 103));
}

}  // namespace
}  // namespace aisle::sim
