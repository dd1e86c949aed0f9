#include "harness/run/playback.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/run/external_result.h"

namespace aisle {
namespace {

constexpr int kFrames = 10;
constexpr std::int64_t kStepNs = 50'000'000;

/// A mover covers a quarter of every image.
class QuarterSequence : public Sequence {
 public:
  std::string name() const override { return "quarter"; }
  StereoCalibration calibration() const override { return {8, 8, 10, 10, 4, 4, 0.1}; }
  double rate_hz() const override { return 20; }
  std::vector<FrameRequest> Schedule() const override {
    std::vector<FrameRequest> schedule;
    for (int k = 0; k < kFrames; ++k) {
      schedule.push_back({k, k * kStepNs, Eigen::Isometry3d::Identity()});
    }
    return schedule;
  }
  SequenceFrame At(const FrameRequest& request) const override {
    SequenceFrame frame;
    frame.images = {request.id, request.stamp_ns, cv::Mat1b(8, 8), cv::Mat1b(8, 8)};
    frame.images.left = static_cast<unsigned char>(90);
    frame.truth.emplace();
    frame.truth->dynamic = cv::Mat1b(8, 8, static_cast<unsigned char>(0));
    frame.truth->dynamic(cv::Rect(0, 0, 4, 4)) = 255;
    return frame;
  }
};

/// A drive of which nothing but the poses is known; frame 3 has none.
RunResult Blind() {
  Trajectory truth, estimate;
  for (int k = 0; k < kFrames; ++k) {
    truth.push_back({k * kStepNs, Eigen::Isometry3d::Identity()});
    if (k != 3) estimate.push_back(truth.back());
  }
  RunResult result = ResultFromTrajectory(truth, estimate);
  result.wall_s = 0.5;
  return result;
}

FrameEstimate OnTheMover(const StereoFrame&) {
  FrameEstimate estimate;
  estimate.keypoints = {{1, 1}, {6, 6}};
  estimate.keypoint_is_inlier = {true, true};
  estimate.regions.mask = cv::Mat1b(8, 8, static_cast<unsigned char>(0));
  estimate.regions.mask(cv::Rect(0, 0, 4, 8)) = 255;
  return estimate;
}

TEST(PlaybackTest, TruthIsToldWhatTheSystemLeft) {
  RunResult result = Blind();
  SpreadWallTime(&result);
  std::size_t seen = 0;
  PlayBack(
      QuarterSequence(), OnTheMover, [&](const DrivenFrame&) { ++seen; }, &result);
  EXPECT_EQ(seen, static_cast<std::size_t>(kFrames));
  EXPECT_THAT(result.notes, testing::IsEmpty());
  ASSERT_EQ(result.facts.size(), static_cast<std::size_t>(kFrames));
  EXPECT_DOUBLE_EQ(result.facts[0].movers_share, 0.25);
  EXPECT_EQ(result.facts[0].features_on_movers, 1);
  EXPECT_EQ(result.facts[0].inliers_on_movers, 1);
  ASSERT_TRUE(result.facts[0].mask.has_value());
  EXPECT_EQ(result.facts[0].mask->true_positives, 16);
  EXPECT_EQ(result.facts[0].mask->false_positives, 16);
  EXPECT_DOUBLE_EQ(result.facts[0].process_ms, 50);  // its share of half a second
}

TEST(PlaybackTest, PosesAndVerdictStayAsTheyAre) {
  RunResult result = Blind();
  result.status = RunStatus::kLost;
  PlayBack(QuarterSequence(), {}, {}, &result);
  EXPECT_EQ(result.status, RunStatus::kLost);
  EXPECT_EQ(result.trajectory.live.size(), static_cast<std::size_t>(kFrames) - 1);
  EXPECT_FALSE(result.estimates[3].T_world_rig.has_value());
  EXPECT_FALSE(result.facts[0].mask.has_value());  // it rejected nothing
}

TEST(PlaybackTest, WhatDoesNotFitIsANoteAndTheDriveStands) {
  RunResult result = Blind();
  PlayBack(
      QuarterSequence(),
      [](const StereoFrame&) {
        FrameEstimate estimate;
        estimate.regions.mask = cv::Mat1b(3, 3, static_cast<unsigned char>(255));
        return estimate;
      },
      {}, &result);
  ASSERT_EQ(result.notes.size(), 1u);
  EXPECT_THAT(result.notes[0], testing::HasSubstr("the mask and the image differ in size"));
  EXPECT_EQ(result.facts.size(), static_cast<std::size_t>(kFrames));
  EXPECT_EQ(result.status, RunStatus::kOk);
}

}  // namespace
}  // namespace aisle
