#include "slam/flow/flow_pyramid.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace aisle::slam {
namespace {

/// A plane of grey that rises by so much a pixel: its derivatives are known everywhere.
cv::Mat1b Ramp(cv::Size size, double along_x, double along_y) {
  cv::Mat1b image(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      image(y, x) = cv::saturate_cast<unsigned char>(20 + along_x * x + along_y * y);
    }
  }
  return image;
}

TEST(MakeFlowPyramid, GradientsAreGreyLevelsPerPixelAtEachSize) {
  const FlowPyramid pyramid = MakeFlowPyramid(Ramp({96, 64}, 2, 0), {.finest_scale = 0});
  ASSERT_GE(pyramid.size(), 2U);
  double per_pixel = 2;
  for (const FlowLevel& level : pyramid) {
    const cv::Rect inside(2, 2, level.image.cols - 4, level.image.rows - 4);
    EXPECT_NEAR(cv::mean(level.gradient_x(inside))[0], per_pixel, 0.05 * per_pixel);
    EXPECT_NEAR(cv::mean(level.gradient_y(inside))[0], 0, 0.05);
    per_pixel *= 2;  // half the size, twice as steep
  }
}

TEST(MakeFlowPyramid, EachSizeIsHalfTheOneBeforeAndTheFinestIsAsAsked) {
  for (const int finest : {0, 1, 2}) {
    const FlowPyramid pyramid = MakeFlowPyramid(Ramp({160, 128}, 1, 0.5), {.finest_scale = finest});
    ASSERT_FALSE(pyramid.empty());
    EXPECT_EQ(pyramid[0].image.size(), cv::Size(160 >> finest, 128 >> finest));
    for (std::size_t k = 1; k < pyramid.size(); ++k) {
      EXPECT_EQ(pyramid[k].image.size(), pyramid[k - 1].image.size() / 2);
    }
  }
}

TEST(MakeFlowPyramid, AnImageOfAPatchOrLessIsNone) {
  EXPECT_TRUE(MakeFlowPyramid(Ramp({4, 4}, 1, 1), {}).empty());
}

}  // namespace
}  // namespace aisle::slam
