#include <gtest/gtest.h>

#include <algorithm>

#include "slam/dynamic/robust/robust_method.h"
#include "tests/slam/dynamic/synthetic_stereo.h"

namespace aisle::slam::dynamic {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kStep_s = 0.05;

/// Of each frame the share of a panel that is masked.
std::vector<double> MaskedShares(const test::Panel& panel, double rig_mps, int frames) {
  auto panels = test::StaticHall();
  panels.push_back(panel);
  Isometry3d T_world_rig = Isometry3d::Identity();
  RobustState state;
  std::vector<double> shares;
  for (int k = 0; k < frames; ++k) {
    const auto view = test::Render(panels, {}, T_world_rig, k * kStep_s, 2.0);
    RobustResult result = StepRobust(state, {view.left, view.right}, k * 50'000'000LL, {}, {}, {});
    state = std::move(result.state);
    T_world_rig = T_world_rig * Eigen::Translation3d(0, 0, rig_mps * kStep_s);
    const cv::Mat shown = view.panel == static_cast<int>(panels.size());
    shares.push_back(static_cast<double>(cv::countNonZero(shown & result.dynamic.mask)) /
                     cv::countNonZero(shown));
  }
  return shares;
}

int FramesBelow(const std::vector<double>& shares, int from, double least) {
  return static_cast<int>(
      std::count_if(shares.begin() + from, shares.end(), [&](double s) { return s < least; }));
}

/// Above 0.1 m/s within a second, below within two.
TEST(SlowMovers, AreFoundAndHeldBesideAMovingRig) {
  for (const double speed : {0.06, 0.12}) {
    const auto shares = MaskedShares(test::Walker({0.2, 0.1, 3.4}, {speed, 0, 0}), 0.3, 60);
    EXPECT_EQ(FramesBelow(shares, speed < 0.1 ? 40 : 21, 0.5), 0) << speed << " m/s";
  }
}

TEST(SlowMovers, AreFoundAlongTheAxisBeforeAStandingRig) {
  const auto shares = MaskedShares(test::Walker({0.3, 0.1, 3.0}, {0, 0, -0.15}), 0, 60);
  EXPECT_LT(FramesBelow(shares, 40, 0.5), 3);
}

std::vector<int> Numbers(const std::vector<DenseFrame>& frames) {
  std::vector<int> numbers;
  for (const DenseFrame& frame : frames) numbers.push_back(frame.number);
  return numbers;
}

TEST(KeptFrames, AreTheLatestAndKeyframesBefore) {
  std::vector<DenseFrame> frames;
  for (int k = 0; k < 83; ++k) frames = WithFrame(std::move(frames), {});
  RobustState state;
  state.frames = frames;
  EXPECT_EQ(frames.back().number, 82);
  for (const int gap : kGaps) EXPECT_EQ(FrameAgo(state, gap).number, 83 - gap);
  EXPECT_EQ(Numbers({frames.begin(), frames.begin() + 10}),
            std::vector<int>({25, 30, 35, 40, 45, 50, 55, 60, 65, 68}));
  EXPECT_EQ(GapTo(frames.front(), state), 58);
}

}  // namespace
}  // namespace aisle::slam::dynamic
