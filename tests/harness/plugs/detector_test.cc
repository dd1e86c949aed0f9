#include "harness/plugs/detector.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "harness/io/input_error.h"
#include "harness/plugs/systems.h"

namespace aisle {
namespace {

constexpr StereoCalibration kRig{
    .width = 320, .height = 240, .fx = 200, .fy = 200, .cx = 160, .cy = 120, .baseline_m = 0.12};

/// Noise behind, and before it a square of other noise that moves to the right.
StereoFrame Frame(int index) {
  cv::Mat1b back(kRig.height, kRig.width + 20), front(90, 90);
  cv::RNG random(7);
  random.fill(back, cv::RNG::UNIFORM, 0, 255);
  random.fill(front, cv::RNG::UNIFORM, 0, 255);
  cv::GaussianBlur(back, back, {5, 5}, 1.5);
  cv::GaussianBlur(front, front, {5, 5}, 1.5);
  StereoFrame frame;
  frame.id = index;
  frame.stamp_ns = index * 50'000'000LL;
  frame.left = back(cv::Rect(0, 0, kRig.width, kRig.height)).clone();
  frame.right = back(cv::Rect(6, 0, kRig.width, kRig.height)).clone();
  front.copyTo(frame.left(cv::Rect(120 + 3 * index, 80, 90, 90)));
  front.copyTo(frame.right(cv::Rect(120 + 3 * index - 20, 80, 90, 90)));
  return frame;
}

TEST(DetectorTest, AloneItRejectsWhatTheSystemRejects) {
  const SystemSpec paper = BuiltIn("paper");
  const auto detector = MakeDetector(paper, kRig);
  const auto system = MakeSystem(paper, kRig);
  int rejected = 0;
  for (int i = 0; i < 4; ++i) {
    const Detector::Found found = detector->Detect(Frame(i));
    const FrameEstimate estimate = system->Process(Frame(i), {});
    ASSERT_EQ(found.regions.mask.size(), estimate.regions.mask.size());
    if (found.regions.mask.empty()) continue;
    EXPECT_EQ(cv::norm(found.regions.mask, estimate.regions.mask, cv::NORM_INF), 0) << i;
    rejected += cv::countNonZero(found.regions.mask);
    EXPECT_GT(found.stage_ms.at("dynamic"), 0);
  }
  EXPECT_GT(rejected, 0);
}

TEST(DetectorTest, LossesAreToldOfKeptStagesAlone) {
  FrameTruth truth;
  truth.dynamic = cv::Mat1b(kRig.height, kRig.width, static_cast<unsigned char>(0));
  truth.instance = cv::Mat1w(truth.dynamic.size(), static_cast<unsigned short>(0));
  const cv::Rect corner(0, 0, 40, 40);  // where nothing moves for the method
  truth.dynamic(corner).setTo(255);
  truth.instance(corner).setTo(3);
  for (const bool keep : {false, true}) {
    const auto detector = MakeDetector(BuiltIn("paper"), kRig, keep);
    detector->Detect(Frame(0));
    detector->Detect(Frame(1));
    const std::map<int, std::string> losses = detector->FindLosses(truth, truth);
    EXPECT_EQ(losses.size(), keep ? 1u : 0u);
    EXPECT_EQ(losses.contains(3), keep);
  }
}

TEST(DetectorTest, ACommandAndOptionsThatContradictAreRefused) {
  SystemSpec foreign{.name = "mine"};
  foreign.external.emplace();
  EXPECT_THROW(MakeDetector(foreign, kRig), InputError);
  SystemSpec wrong = BuiltIn("paper");
  wrong.options["dynamic.paper.boundary.lambda_hinge"] = "40";
  EXPECT_THROW(MakeDetector(wrong, kRig), InputError);
}

}  // namespace
}  // namespace aisle
