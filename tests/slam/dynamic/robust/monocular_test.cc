#include "slam/dynamic/robust/monocular.h"

#include <gtest/gtest.h>

#include "slam/stereo/dense/disparity_image.h"

namespace aisle::slam::dynamic {
namespace {

const StereoCamera kHalf = HalfCamera({});
const cv::Size kSize(kHalf.width, kHalf.height);

/// A wall at 10 pixels of disparity whose left 60 columns only the left camera sees, with texture
/// everywhere, and a rig that has come `way` from where the earlier frame was and has turned about
/// its camera.
struct Entrance {
  DenseFrame now;
  Texture texture{cv::Mat1f(kSize, 50.0F), cv::Mat1f(kSize, 0.0F), cv::Mat1f(kSize, 50.0F)};
  Eigen::Isometry3d T_then_now = Eigen::Isometry3d::Identity();

  explicit Entrance(const Eigen::Vector3d& way, double yaw_rad = 0) {
    now.disparity = cv::Mat1f(kSize, 10.0F);
    now.disparity.colRange(0, 60).setTo(kNoDisparity);
    now.filled = cv::Mat1f(kSize, 10.0F);
    T_then_now.translation() = way;
    T_then_now.rotate(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitY()));
  }

  /// What remains of the flow of a pixel that something static at `disparity` has, moved by `off`.
  cv::Vec2f Unexplained(cv::Point at, float disparity, const cv::Vec2f& off) const {
    const cv::Mat1f surface(kSize, disparity);
    cv::Mat2f flow = WhereStatic(surface, T_then_now, kHalf).place;
    flow += cv::Scalar(off[0], off[1]);
    StaticField expected = WhereStatic(now.filled, T_then_now, kHalf);
    ExplainMonocular(now, flow, texture, &expected);
    return flow(at) - expected.place(at);
  }
};

TEST(MonocularColumns, AreThoseBeforeTheFirstRunOfDisparities) {
  std::vector<float> row(40, kNoDisparity);
  EXPECT_EQ(MonocularColumns(row.data(), 40), 0);  // it knows of none
  row[5] = row[6] = 3;                             // chance
  std::fill(row.begin() + 20, row.end(), 8.0F);
  EXPECT_EQ(MonocularColumns(row.data(), 40), 20);
}

TEST(ExplainMonocular, WhateverIsStaticIsExplainedAtAnyDistance) {
  for (const Eigen::Vector3d& way : {Eigen::Vector3d(0, 0, 0.001), Eigen::Vector3d(0, 0, 0)}) {
    const Entrance entrance(way);
    for (const float disparity : {2.0F, 10.0F, 40.0F}) {
      const cv::Vec2f left = entrance.Unexplained({30, 200}, disparity, {0, 0});
      EXPECT_LT(cv::norm(left), 0.02) << disparity;
    }
  }
}

TEST(ExplainMonocular, AStandingRigSeesAllMotion) {
  const cv::Vec2f off(1.5F, -0.5F);
  const cv::Vec2f left = Entrance({0, 0, 0}).Unexplained({30, 200}, 10, off);
  EXPECT_NEAR(cv::norm(left - off), 0, 1e-4);
}

TEST(ExplainMonocular, ARigThatTurnsAboutItsCameraSeesAllMotionAsWell) {
  const Entrance turned({0, 0, 0}, 0.02);
  const cv::Vec2f off(1.5F, -0.5F);
  for (const float disparity : {2.0F, 10.0F, 40.0F}) {
    EXPECT_LT(cv::norm(turned.Unexplained({30, 200}, disparity, {0, 0})), 0.02) << disparity;
    EXPECT_LT(cv::norm(turned.Unexplained({30, 200}, disparity, off) - off), 0.02) << disparity;
  }
}

/// Of somebody close by, whom the camera has come a millimetre towards.
TEST(ExplainMonocular, TheDisparityThatIsExpectedIsThatOfTheEarlierFrame) {
  const Entrance entrance({0, 0, 0.001}, 0.02);
  const cv::Point at(30, 200);
  const StaticField near = WhereStatic(cv::Mat1f(kSize, 40.0F), entrance.T_then_now, kHalf);
  StaticField expected = WhereStatic(entrance.now.filled, entrance.T_then_now, kHalf);
  const cv::Mat1f disparity =
      ExplainMonocular(entrance.now, near.place, entrance.texture, &expected);
  EXPECT_NEAR(disparity(at), 40, 0.5);
  EXPECT_GT(std::abs(near.disparity(at) - 40), 0.3) << "the turn makes a difference";
  EXPECT_NEAR(expected.disparity(at) / disparity(at), near.disparity(at) / 40, 0.003);
}

TEST(ExplainMonocular, SaysNothingWhereWhoMovesMayBeNear) {
  for (const Entrance& moved :
       {Entrance({0, 0, 0.03}), Entrance({0.006, 0, 0}), Entrance({0.006, 0, 0}, 0.02)}) {
    StaticField expected = WhereStatic(moved.now.filled, moved.T_then_now, kHalf);
    const cv::Mat2f flow = expected.place.clone();
    const cv::Mat1f disparity = ExplainMonocular(moved.now, flow, moved.texture, &expected);
    EXPECT_EQ(cv::norm(disparity, moved.now.disparity, cv::NORM_INF), 0);
  }
}

TEST(ExplainMonocular, LeavesWhatHasADisparity) {
  const Entrance entrance({0, 0, 0.001});
  const StaticField measured = WhereStatic(entrance.now.filled, entrance.T_then_now, kHalf);
  StaticField expected = WhereStatic(entrance.now.filled, entrance.T_then_now, kHalf);
  cv::Mat2f flow = measured.place.clone();
  flow += cv::Scalar(2, 1);
  const cv::Mat1f disparity = ExplainMonocular(entrance.now, flow, entrance.texture, &expected);
  EXPECT_EQ(disparity(200, 100), 10);
  EXPECT_EQ(expected.place(200, 100), measured.place(200, 100));
  EXPECT_EQ(expected.per_disparity(200, 100), measured.per_disparity(200, 100));
  EXPECT_GT(disparity(200, 30), 0);
  EXPECT_EQ(expected.per_disparity(200, 30), cv::Vec2f(0, 0));
}

}  // namespace
}  // namespace aisle::slam::dynamic
