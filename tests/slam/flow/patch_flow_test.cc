#include "slam/flow/patch_flow.h"

#include <gtest/gtest.h>

#include "slam/flow/refine_flow.h"
#include "tests/slam/dynamic/synthetic_stereo.h"

namespace aisle::slam::dynamic {
namespace {

/// Smooth texture, a pixel at x of which is seen at x + shift.
cv::Mat1b Textured(cv::Size size, cv::Point2d shift) {
  cv::Mat1b image(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const double s = (x - shift.x) / 9, t = (y - shift.y) / 9;
      image(y, x) = cv::saturate_cast<unsigned char>(128 + 60 * test::ValueNoise(s, t, 3) +
                                                     30 * test::ValueNoise(2 * s, 2 * t, 4));
    }
  }
  return image;
}

cv::Mat1f Float(const cv::Mat1b& image) {
  cv::Mat1f numbers;
  image.convertTo(numbers, CV_32F);
  return numbers;
}

cv::Mat2f Flow(const cv::Mat1b& image, const cv::Mat1b& view,
               const DenseFlowOptions& options = {}) {
  return FlowTo(view, MakeFlowPyramid(image, options), options);
}

/// The farthest that a flow lies from a shift, away from the edges.
double WorstError(const cv::Mat2f& flow, cv::Point2d shift, int margin) {
  double worst = 0;
  for (int y = margin; y < flow.rows - margin; ++y) {
    for (int x = margin; x < flow.cols - margin; ++x) {
      worst = std::max(worst, std::hypot(flow(y, x)[0] - shift.x, flow(y, x)[1] - shift.y));
    }
  }
  return worst;
}

TEST(FlowTo, FindsAShiftOfSeveralPixelsToAFractionOfOne) {
  const cv::Size size(180, 118);
  for (const cv::Point2d shift :
       {cv::Point2d(0, 0), cv::Point2d(0.5, -0.25), cv::Point2d(-6.3, 3.6)}) {
    const cv::Mat2f flow = Flow(Textured(size, {0, 0}), Textured(size, shift));
    ASSERT_EQ(flow.size(), size);
    EXPECT_LT(WorstError(flow, shift, 24), 0.2) << shift;
  }
}

TEST(FlowTo, FindsWhatMovesBeforeWhatStands) {
  const cv::Size size(180, 118);
  const cv::Mat1b image = Textured(size, {0, 0});
  cv::Mat1b view = image.clone();
  const cv::Rect mover(60, 40, 50, 50);
  image(mover).copyTo(view(mover + cv::Point(4, 0)));
  const cv::Mat2f flow = Flow(image, view);
  EXPECT_LT(WorstError(flow(cv::Rect(75, 52, 22, 26)), {4, 0}, 0), 0.3);
  EXPECT_LT(WorstError(flow(cv::Rect(5, 5, 30, 108)), {0, 0}, 0), 0.1);
}

TEST(FlowTo, IsZeroWhereNothingCanBeSeen) {
  const cv::Mat1b plain(90, 120, static_cast<unsigned char>(77));
  EXPECT_EQ(cv::norm(Flow(plain, plain), cv::NORM_INF), 0);
  const cv::Mat1b brighter(plain.size(), static_cast<unsigned char>(97));
  EXPECT_LT(cv::norm(Flow(plain, brighter), cv::NORM_INF), 1e-3);
}

TEST(FlowTo, HeedsNoChangeOfBrightnessInItsSearch) {
  const cv::Size size(180, 118);
  const cv::Mat1b image = Textured(size, {0, 0});
  cv::Mat1b view;
  Textured(size, {2.5, 1}).convertTo(view, CV_8U, 1, -15);
  EXPECT_LT(WorstError(Flow(image, view, {.refinements = 0}), {2.5, 1}, 14), 0.3);
}

TEST(FlowTo, TakesImagesOfAnySize) {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(7, 200), cv::Size(27, 28), cv::Size(28, 28),
                              cv::Size(31, 45), cv::Size(131, 33)}) {
    const cv::Mat1b image = Textured(size, {0, 0});
    const cv::Mat2f flow = Flow(image, image);
    ASSERT_EQ(flow.size(), size);
    EXPECT_LT(cv::norm(flow, cv::NORM_INF), 1e-3) << size;
  }
}

TEST(MakeFlowPyramid, HoldsPatchesUpToTheFarEdges) {
  for (const FlowLevel& level : MakeFlowPyramid(Textured({187, 121}, {0, 0}), {})) {
    cv::Mat1b covered(level.image.size(), static_cast<unsigned char>(0));
    for (const FlowPatch& patch : level.patches) {
      covered(cv::Rect(patch.x, patch.y, kFlowPatch, kFlowPatch)) = 1;
    }
    EXPECT_EQ(cv::countNonZero(covered), static_cast<int>(covered.total()));
  }
}

/// Mean distance of numbers from what they should be, away from the edges.
double MeanError(const cv::Mat1f& of, float truth) {
  const cv::Rect inner(10, 10, of.cols - 20, of.rows - 20);
  return cv::norm(of(inner), cv::Mat1f(inner.size(), truth), cv::NORM_L1) / inner.area();
}

TEST(RefineFlow, BringsAFlowWithErrorsNearer) {
  const cv::Size size(96, 64);
  const cv::Mat1f image = Float(Textured(size, {0, 0})), view = Float(Textured(size, {1.5, -1}));
  cv::Mat1f u(size, 1.5F), v(size, -1.0F);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      u(y, x) += (x / 6 + y / 6) % 2 == 0 ? 0.4F : -0.4F;
      v(y, x) += (x / 6 + y / 4) % 2 == 0 ? 0.3F : -0.3F;
    }
  }
  RefineFlow(image, view, 4, u, v);
  EXPECT_LT(MeanError(u, 1.5F), 0.2);
  EXPECT_LT(MeanError(v, -1.0F), 0.15);
}

TEST(RefineFlow, LeavesWhatIsTrue) {
  const cv::Size size(96, 64);
  const cv::Mat1f image = Float(Textured(size, {0, 0}));
  cv::Mat1f u(size, 0.0F), v(size, 0.0F);
  RefineFlow(image, image, 3, u, v);
  EXPECT_LT(cv::norm(u, cv::NORM_INF) + cv::norm(v, cv::NORM_INF), 1e-4);
}

TEST(RefineFlow, SmoothsWhatThePicturesDoNotTell) {
  const cv::Size size(40, 30);
  const cv::Mat1f plain(size, 90.0F);
  cv::Mat1f u(size, 1.0F), v(size, 0.0F);
  u(cv::Rect(18, 12, 4, 4)) = 1.3F;
  RefineFlow(plain, plain, 4, u, v);
  EXPECT_LT(cv::norm(u, cv::Mat1f(size, 1.0F), cv::NORM_INF), 0.25);
  EXPECT_EQ(cv::norm(v, cv::NORM_INF), 0);
}

}  // namespace
}  // namespace aisle::slam::dynamic
