#include "slam/picture/draw_stages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <set>

#include "slam/dynamic/dynamic_detector.h"
#include "slam/dynamic/dynamic_stages.h"
#include "slam/picture/canvas.h"
#include "slam/picture/draw_paper.h"
#include "slam/picture/draw_regions.h"
#include "tests/slam/dynamic/synthetic_stereo.h"

namespace aisle::slam {
namespace {

using dynamic::BoundaryType;
using picture::Colour;

constexpr int kWidth = 200, kHeight = 120;

/// A frame of the paper's method in which two points were tested and one region of interest, cut
/// into a left and a right half, was found.
DynamicStages PaperFrame(BoundaryType type = BoundaryType::kLeftOcclusion) {
  DynamicStages stages;
  stages.left = cv::Mat1b(kHeight, kWidth, 100);
  stages.regions.mask = cv::Mat1b(kHeight, kWidth, static_cast<unsigned char>(0));
  PaperTrace trace;
  trace.stages.disparity = cv::Mat1f(kHeight, kWidth, 10.0F);
  trace.stages.fundamental.found = true;
  trace.stages.points = {
      {.position = {30, 40}, .disparity = 10, .epipolar_px = 0.7, .threshold_px = 1},
      {.position = {118, 60}, .disparity = 10, .epipolar_px = 2.5, .threshold_px = 1}};
  dynamic::PointGroup group{{trace.stages.points[1]}, cv::Rect(110, 40, 40, 40)};
  dynamic::SegmentedRoi roi;
  roi.roi = group.roi;
  roi.superpixels.labels = cv::Mat1i(40, 40, 0);
  roi.superpixels.labels.colRange(24, 40).setTo(1);
  roi.superpixels.iterations = 1;
  roi.planes.resize(2);
  roi.boundaries = {{{0, 1}, type}};
  trace.stages.groups = {group};
  trace.stages.rois = {roi};
  stages.paper = trace;
  return stages;
}

const cv::Mat3b& Named(const std::vector<StagePicture>& pictures, const std::string& name) {
  for (const StagePicture& picture : pictures) {
    if (picture.name == name) return picture.image;
  }
  throw std::invalid_argument("no picture " + name);
}

/// The pixel that shows this place of the left image.
Colour Pixel(const cv::Mat3b& framed, int x, int y) { return framed(y + picture::kTitleHeight, x); }

constexpr int kFrames = 4;

/// A walker before a standing rig, rendered once.
const std::vector<test::SyntheticView>& Views() {
  static const std::vector<test::SyntheticView> views = [] {
    auto panels = test::StaticHall();
    panels.push_back(test::Walker({-0.5, 0.1, 3.2}, {1.2, 0, 0}));
    std::vector<test::SyntheticView> rendered;
    for (int k = 0; k < kFrames; ++k) {
      rendered.push_back(test::Render(panels, {}, Eigen::Isometry3d::Identity(), 0.05 * k));
    }
    return rendered;
  }();
  return views;
}

DynamicOutput LastOf(DynamicMethod method, bool keep_stages, int frames = kFrames) {
  DynamicOptions options;
  options.method = method;
  options.keep_stages = keep_stages;
  DynamicDetector detector({}, options);
  DynamicOutput output;
  for (int k = 0; k < frames; ++k) {
    const test::SyntheticView& view = Views()[static_cast<std::size_t>(k)];
    output = detector.Detect({.stamp_ns = k * 50'000'000LL,
                              .left = view.left,
                              .right = view.right,
                              .expected = std::nullopt});
  }
  return output;
}

class EitherMethod : public testing::TestWithParam<DynamicMethod> {};

TEST_P(EitherMethod, KeepingTheStagesChangesNoBit) {
  const DynamicOutput with = LastOf(GetParam(), true), without = LastOf(GetParam(), false);
  EXPECT_EQ(without.stages, nullptr);
  ASSERT_NE(with.stages, nullptr);
  EXPECT_GT(cv::countNonZero(with.regions.mask), 0);
  EXPECT_EQ(cv::norm(with.regions.mask, without.regions.mask, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(with.mask_right, without.mask_right, cv::NORM_INF), 0);
  ASSERT_EQ(with.probability.size(), without.probability.size());
  if (!with.probability.empty()) {
    EXPECT_EQ(cv::norm(with.probability, without.probability, cv::NORM_INF), 0);
  }
  ASSERT_EQ(with.regions.regions.size(), without.regions.regions.size());
  for (std::size_t k = 0; k < with.regions.regions.size(); ++k) {
    EXPECT_EQ(with.regions.regions[k].box, without.regions.regions[k].box);
    EXPECT_EQ(with.regions.regions[k].evidence, without.regions.regions[k].evidence);
  }
}

TEST_P(EitherMethod, TheStagesKeepTheImageThoughTheCallerUsesItAgain) {
  DynamicOptions options;
  options.method = GetParam();
  options.keep_stages = true;
  DynamicDetector detector({}, options);
  cv::Mat1b left = Views()[0].left.clone(), right = Views()[0].right.clone();
  const DynamicOutput output = detector.Detect({.left = left, .right = right});
  left = 0;
  right = 0;
  EXPECT_EQ(cv::norm(output.stages->left, Views()[0].left, cv::NORM_INF), 0);
}

TEST_P(EitherMethod, DrawsNineStagesOfOneSizeAndTheSameOnesTwice) {
  const DynamicOutput output = LastOf(GetParam(), true);
  const auto once = DrawStages(*output.stages, {}), twice = DrawStages(*output.stages, {});
  ASSERT_EQ(once.size(), 9U);
  std::set<std::string> names;
  for (std::size_t k = 0; k < once.size(); ++k) {
    names.insert(once[k].name);
    EXPECT_EQ(once[k].image.size(),
              cv::Size(752, 480 + picture::kTitleHeight + picture::kLegendHeight));
    EXPECT_EQ(cv::norm(once[k].image, twice[k].image, cv::NORM_INF), 0) << once[k].name;
  }
  EXPECT_EQ(names.size(), once.size());
}

TEST_P(EitherMethod, DrawsNothingOfAFrameWithoutPast) {
  const DynamicOutput first = LastOf(GetParam(), true, 1);
  ASSERT_NE(first.stages, nullptr);
  EXPECT_TRUE(DrawStages(*first.stages, {}).empty());
}

INSTANTIATE_TEST_SUITE_P(DrawStages, EitherMethod,
                         testing::Values(DynamicMethod::kPaper, DynamicMethod::kRobust),
                         [](const auto& method) {
                           return method.param == DynamicMethod::kPaper ? "Paper" : "Robust";
                         });

TEST(DrawEpipolar, APointBeyondItsThresholdIsRedAndOneWithinIsGreen) {
  const auto pictures = DrawStages(PaperFrame(), {});
  const cv::Mat3b& epipolar = Named(pictures, "epipolar");
  EXPECT_EQ(Pixel(epipolar, 30, 40), picture::kStatic);
  EXPECT_EQ(Pixel(epipolar, 118, 60), picture::kDynamic);
}

TEST(DrawBoundaries, EveryTypeHasAColourOfItsOwnAtTheBorder) {
  std::set<std::array<int, 3>> colours;
  for (const BoundaryType type :
       {BoundaryType::kCoplanar, BoundaryType::kHinge, BoundaryType::kLeftOcclusion,
        BoundaryType::kRightOcclusion, BoundaryType::kUnknown}) {
    const auto pictures = DrawStages(PaperFrame(type), {});
    // The last column of the left half, and a place off the border.
    const Colour at = Pixel(Named(pictures, "boundaries"), 110 + 23, 50);
    EXPECT_EQ(at, picture::ColourOf(type));
    EXPECT_NE(at, Pixel(Named(pictures, "boundaries"), 110 + 10, 50));
    colours.insert({at[0], at[1], at[2]});
  }
  EXPECT_EQ(colours.size(), 5U);
}

TEST(DrawRays, ARayEndsAtTheOcclusionAndPassesAHinge) {
  DynamicStages stages = PaperFrame(BoundaryType::kLeftOcclusion);
  stages.paper->options.mark.min_rays = 1;
  const Colour end = Pixel(Named(DrawStages(stages, {}), "rays"), 133, 60);
  EXPECT_EQ(end, picture::kDynamic);
  stages.paper->stages.rois[0].boundaries.begin()->second = BoundaryType::kHinge;
  EXPECT_NE(Pixel(Named(DrawStages(stages, {}), "rays"), 133, 60), picture::kDynamic);
}

TEST(DrawRegions, AgreementIsGreenInventionCyanAndOmissionRed) {
  DynamicStages stages = PaperFrame();
  stages.regions.mask(cv::Rect(40, 30, 60, 60)).setTo(255);
  stages.regions.regions = {{.id = 7, .box = cv::Rect(40, 30, 60, 60), .evidence = 5}};
  StageTruth truth{.moving = cv::Mat1b(kHeight, kWidth, static_cast<unsigned char>(0)),
                   .boxes = {cv::Rect(80, 30, 60, 60)}};
  truth.moving(truth.boxes[0]).setTo(255);
  const cv::Mat3b regions = Named(DrawStages(stages, truth), "regions");
  const Colour both = Pixel(regions, 90, 70), invented = Pixel(regions, 60, 70),
               missed = Pixel(regions, 120, 60), neither = Pixel(regions, 20, 100);
  EXPECT_EQ(neither, Colour(100, 100, 100));
  EXPECT_TRUE(both[1] > both[0] && both[1] > both[2]) << both;
  EXPECT_TRUE(invented[0] > invented[2] && invented[1] > invented[2]) << invented;
  EXPECT_TRUE(missed[2] > missed[0] && missed[2] > missed[1]) << missed;
  EXPECT_EQ(Pixel(regions, 139, 70), picture::kTruth);  // the true box
  EXPECT_EQ(Pixel(regions, 40, 70), picture::kFound);   // ours
}

TEST(BestOverlap, EqualsCountingPixels) {
  const std::vector<cv::Rect> others = {{0, 0, 5, 5}, {3, 4, 10, 6}, {20, 20, 3, 3}};
  for (const cv::Rect& box : {cv::Rect(2, 2, 6, 6), cv::Rect(3, 4, 10, 6), cv::Rect(30, 0, 2, 2)}) {
    double best = 0;
    for (const cv::Rect& other : others) {
      cv::Mat1b a(40, 40, static_cast<unsigned char>(0)), b = a.clone(), both, either;
      a(box).setTo(1), b(other).setTo(1);
      cv::bitwise_and(a, b, both), cv::bitwise_or(a, b, either);
      best = std::max(best, double(cv::countNonZero(both)) / cv::countNonZero(either));
    }
    EXPECT_DOUBLE_EQ(picture::BestOverlap(box, others), best);
  }
  EXPECT_EQ(picture::BestOverlap({0, 0, 5, 5}, {}), 0);
}

TEST(LogOddsColour, TurnsFromBlueToRedAndStaysThere) {
  for (double odds = -6; odds < 6; odds += 0.5) {
    const Colour less = picture::LogOddsColour(odds, 6),
                 more = picture::LogOddsColour(odds + 0.5, 6);
    EXPECT_GE(more[2] - more[0], less[2] - less[0]) << odds;
  }
  EXPECT_EQ(picture::LogOddsColour(60, 6), picture::LogOddsColour(6, 6));
  EXPECT_EQ(picture::LogOddsColour(0, 6), Colour(128, 128, 128));
}

TEST(WheelOf, OppositeDirectionsAreOppositeColoursAndRestIsGrey) {
  const cv::Mat2f vectors = (cv::Mat2f(1, 3) << cv::Vec2f(1, 0), cv::Vec2f(-1, 0), cv::Vec2f(0, 0));
  const cv::Mat3b wheel = picture::WheelOf(vectors, 1);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(wheel(0)[c] + wheel(1)[c], 255, 10);
  EXPECT_EQ(wheel(2)[0], wheel(2)[1]);
  EXPECT_EQ(wheel(2)[1], wheel(2)[2]);
}

TEST(DrawRobust, TheWalkerStandsOutOfWhatTheStaticViewLeaves) {
  const DynamicOutput output = LastOf(DynamicMethod::kRobust, true);
  const RobustTrace& trace = *output.stages->robust;
  const test::SyntheticView& view = Views().back();
  std::vector<float> on, off;
  for (int y = 0; y < trace.residual.rows; ++y) {
    for (int x = 0; x < trace.residual.cols; ++x) {
      const cv::Vec2f& r = trace.residual(y, x);
      (view.moving(2 * y, 2 * x) != 0 ? on : off).push_back(std::hypot(r[0], r[1]));
    }
  }
  std::nth_element(on.begin(), on.begin() + std::ssize(on) / 2, on.end());
  std::nth_element(off.begin(), off.begin() + std::ssize(off) / 2, off.end());
  EXPECT_GT(on[on.size() / 2], 10 * trace.flow_noise);
  EXPECT_LT(off[off.size() / 2], 3 * trace.flow_noise);
}

}  // namespace
}  // namespace aisle::slam
