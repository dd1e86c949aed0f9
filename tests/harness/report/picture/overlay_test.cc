#include "harness/report/picture/overlay.h"

#include <gtest/gtest.h>

namespace aisle {
namespace {

TEST(OverlayTest, MovingPixelsTurnRed) {
  const cv::Mat1b left(480, 752, static_cast<unsigned char>(100));
  FrameTruth truth;
  truth.dynamic = cv::Mat1b(480, 752, static_cast<unsigned char>(0));
  truth.dynamic(cv::Rect(100, 100, 50, 50)) = 255;
  const cv::Mat3b picture = DrawOverlay(left, &truth, nullptr, "caption");
  EXPECT_GT(picture(120, 120)[2], picture(120, 120)[0]);
  EXPECT_EQ(picture(300, 300), cv::Vec3b(100, 100, 100));
}

}  // namespace
}  // namespace aisle
