#include "harness/run/mask_makers.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace aisle {
namespace {

/// Two objects, 1 of 40x40 and 2 of 10x10 pixels, both moving, seen 8 pixels further left by the
/// right camera.
SequenceFrame TwoObjects(std::int64_t id) {
  SequenceFrame frame;
  frame.images = {id, id * 50'000'000, cv::Mat1b(120, 200, static_cast<unsigned char>(90)),
                  cv::Mat1b(120, 200, static_cast<unsigned char>(90))};
  frame.truth.emplace();
  FrameTruth& truth = *frame.truth;
  truth.instance = cv::Mat1w(120, 200, static_cast<unsigned short>(0));
  truth.dynamic = cv::Mat1b(120, 200, static_cast<unsigned char>(0));
  truth.dynamic_right = truth.dynamic.clone();
  const cv::Rect boxes[] = {{40, 30, 40, 40}, {140, 60, 10, 10}};
  for (int k = 0; k < 2; ++k) {
    truth.instance(boxes[k]) = static_cast<unsigned short>(k + 1);
    truth.dynamic(boxes[k]) = 255;
    truth.dynamic_right(boxes[k] - cv::Point(8, 0)) = 255;
  }
  return frame;
}

bool Same(const cv::Mat1b& a, const cv::Mat1b& b) {
  return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0;
}

TEST(MaskMakersTest, WithoutErrorsTheMasksAreTruth) {
  const SequenceFrame frame = TwoObjects(3);
  const ExternalMask mask = MasksWithErrors(MaskSource::kDynamic, {}, 7)(frame);
  EXPECT_TRUE(Same(mask.left, frame.truth->dynamic));
  EXPECT_TRUE(Same(mask.right, frame.truth->dynamic_right));
}

TEST(MaskMakersTest, SmallObjectsAreMissedInBothCameras) {
  const SequenceFrame frame = TwoObjects(3);
  const ExternalMask mask = MasksWithErrors(MaskSource::kDynamic, {.miss_below_px = 200}, 7)(frame);
  EXPECT_EQ(cv::countNonZero(mask.left), 1600);
  EXPECT_EQ(cv::countNonZero(mask.right), 1600);
}

TEST(MaskMakersTest, LatencyHandsOverTheMaskOfAnEarlierFrame) {
  const MaskMaker late = MasksWithErrors(MaskSource::kDynamic, {.latency_frames = 2}, 7);
  SequenceFrame first = TwoObjects(0);
  first.truth->dynamic(cv::Rect(0, 0, 5, 5)) = 255;
  EXPECT_TRUE(late(first).left.empty());
  EXPECT_TRUE(late(TwoObjects(1)).left.empty());
  EXPECT_TRUE(Same(late(TwoObjects(2)).left, first.truth->dynamic));
}

TEST(MaskMakersTest, TheShareOfMissesAndTheWidthOfTheOutlineAreAsAsked) {
  const MaskMaker maker =
      MasksWithErrors(MaskSource::kDynamic, {.boundary_px = 2, .miss_share = 0.3}, 11);
  int missed = 0, frames = 0;
  double sum = 0, squares = 0;
  for (std::int64_t id = 0; id < 4000; id += 10, ++frames) {  // each in a spell of its own
    const ExternalMask mask = maker(TwoObjects(id));
    const int width = cv::boundingRect(mask.left.colRange(0, 120)).width;
    if (width == 0) {
      ++missed;
      continue;
    }
    const double shift = (width - 40) / 2.0;
    sum += shift;
    squares += shift * shift;
  }
  const double seen = frames - missed;
  EXPECT_NEAR(missed / static_cast<double>(frames), 0.3, 0.07);
  EXPECT_NEAR(sum / seen, 0, 0.4);
  EXPECT_NEAR(std::sqrt(squares / seen), 2, 0.4);
}

TEST(MaskMakersTest, ErrorsBelongToTheirFrameAndSeedAlone) {
  const MaskErrors errors{.boundary_px = 3, .miss_share = 0.3};
  const MaskMaker through = MasksWithErrors(MaskSource::kDynamic, errors, 5);
  for (std::int64_t id = 0; id < 20; ++id) {
    const MaskMaker fresh = MasksWithErrors(MaskSource::kDynamic, errors, 5);
    EXPECT_TRUE(Same(through(TwoObjects(id)).left, fresh(TwoObjects(id)).left)) << id;
  }
}

}  // namespace
}  // namespace aisle
