#include "harness/score/difficulty.h"

#include <gtest/gtest.h>

namespace aisle {
namespace {

const StereoCalibration kCamera{
    .width = 320, .height = 240, .fx = 200, .fy = 200, .cx = 160, .cy = 120, .baseline_m = 0.1};

constexpr double kFrameMs = 50;
const cv::Mat1b kBlack(240, 320, static_cast<unsigned char>(0));

FrameTruth Wall(double z_m) {
  FrameTruth truth;
  truth.depth = cv::Mat1f(240, 320, static_cast<float>(z_m));
  truth.dynamic = cv::Mat1b(240, 320, static_cast<unsigned char>(0));
  return truth;
}

TEST(DifficultyTest, ASidewaysStepMovesAWallByFocalLengthTimesStepOverDepth) {
  const FrameTruth truth = Wall(4);
  Eigen::Isometry3d before = Eigen::Isometry3d::Identity();
  before.translation().x() = -0.1;
  const Difficulty d = DifficultyOf(kBlack, truth, kCamera, before, kFrameMs);
  EXPECT_NEAR(*d.parallax_px, 200 * 0.1 / 4, 1e-5);
  EXPECT_NEAR(*d.flow_px, *d.parallax_px, 1e-9);
  EXPECT_EQ(*d.blur_px, 0);
}

TEST(DifficultyTest, AnOpenShutterSmearsItsShareOfTheMotion) {
  FrameTruth truth = Wall(4);
  truth.smear_ms = 10;
  Eigen::Isometry3d before = Eigen::Isometry3d::Identity();
  before.translation().x() = -0.1;
  EXPECT_NEAR(*DifficultyOf(kBlack, truth, kCamera, before, kFrameMs).blur_px, 5 * 0.2, 1e-5);
}

TEST(DifficultyTest, ATurnOnTheSpotIsMotionWithoutParallax) {
  const FrameTruth truth = Wall(4);
  Eigen::Isometry3d before = Eigen::Isometry3d::Identity();
  before.linear() = Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const Difficulty d = DifficultyOf(kBlack, truth, kCamera, before, kFrameMs);
  EXPECT_NEAR(*d.parallax_px, 0, 1e-9);
  EXPECT_GT(*d.flow_px, 9);
}

TEST(DifficultyTest, OnlyStaticTextureCounts) {
  cv::Mat1b left(240, 320, static_cast<unsigned char>(50));
  left(cv::Rect(0, 0, 160, 240)).forEach([](unsigned char& pixel, const int* at) {
    pixel = ((at[0] / 2 + at[1] / 2) % 2) != 0 ? 200 : 20;
  });
  FrameTruth truth = Wall(4);
  const double half = *DifficultyOf(left, truth, kCamera, {}, kFrameMs).static_texture_share;
  EXPECT_NEAR(half, 0.5, 0.02);
  truth.dynamic(cv::Rect(0, 0, 80, 240)) = 255;
  EXPECT_NEAR(*DifficultyOf(left, truth, kCamera, {}, kFrameMs).static_texture_share, half - 0.25,
              0.01);
}

TEST(DifficultyTest, TheGridOfDepthTellsTheSameAsTheWholeOfIt) {
  FrameTruth truth = Wall(4);
  cv::randu(truth.depth, 1, 9);
  Eigen::Isometry3d before = Eigen::Isometry3d::Identity();
  before.translation() = Eigen::Vector3d(0.02, 0.01, -0.05);
  const cv::Mat1b left(240, 320, static_cast<unsigned char>(0));
  const Difficulty whole = DifficultyOf(left, truth, kCamera, before, kFrameMs);
  truth.depth_grid = DepthGrid(truth.depth);
  truth.depth.release();
  const Difficulty grid = DifficultyOf(left, truth, kCamera, before, kFrameMs);
  EXPECT_EQ(whole.flow_px, grid.flow_px);
  EXPECT_EQ(whole.parallax_px, grid.parallax_px);
  truth.depth_grid.release();
  EXPECT_FALSE(DifficultyOf(left, truth, kCamera, before, kFrameMs).flow_px.has_value());
}

}  // namespace
}  // namespace aisle
