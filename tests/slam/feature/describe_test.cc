#include "slam/feature/describe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "slam/feature/extract.h"
#include "tests/slam/stereo/synthetic_view.h"

namespace aisle::slam {
namespace {

const cv::Size kSize(300, 300);
constexpr double kMiddle = 149.5;

/// The smaller angle between two directions, degrees.
double Between(double a_deg, double b_deg) { return std::abs(std::remainder(a_deg - b_deg, 360)); }

/// A texture that is turned about the image's middle, from x towards y.
cv::Mat1b Turned(double angle_deg) {
  const Texture texture(11);
  const double c = std::cos(angle_deg * M_PI / 180), s = std::sin(angle_deg * M_PI / 180);
  return Render(kSize, [&](double u, double v) {
    const double x = u - kMiddle, y = v - kMiddle;
    return texture(c * x + s * y, c * y - s * x);
  });
}

/// Where Turned shows what is at `pixel` before the turn.
cv::Point Follow(const cv::Point& pixel, double angle_deg) {
  const double c = std::cos(angle_deg * M_PI / 180), s = std::sin(angle_deg * M_PI / 180);
  const double x = pixel.x - kMiddle, y = pixel.y - kMiddle;
  return {cvRound(kMiddle + c * x - s * y), cvRound(kMiddle + s * x + c * y)};
}

/// Corners whose disc and pattern stay inside however the image is turned.
std::vector<cv::Point> Corners(const cv::Mat1b& image) {
  std::vector<cv::Point> corners;
  for (const Corner& corner : DetectCorners(image, {})) {
    const double from_middle = std::hypot(corner.x - kMiddle, corner.y - kMiddle);
    if (from_middle < 120) corners.emplace_back(corner.x, corner.y);
  }
  return corners;
}

Descriptor Describe(const cv::Mat1b& image, cv::Point pixel) {
  return DescribePixels(image, {{pixel, OrientationDeg(image, pixel)}}).front();
}

int Median(std::vector<int> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

TEST(OrientationDeg, IsTheDirectionInWhichItGetsBrighter) {
  for (int angle_deg = 0; angle_deg < 360; angle_deg += 15) {
    const double x = std::cos(angle_deg * M_PI / 180), y = std::sin(angle_deg * M_PI / 180);
    const cv::Mat1b ramp = Render(
        {41, 41}, [&](double u, double v) { return 128 + 4 * (x * (u - 20) + y * (v - 20)); });
    const float found_deg = OrientationDeg(ramp, {20, 20});
    EXPECT_LT(Between(found_deg, angle_deg), 0.5) << angle_deg;
    EXPECT_GE(found_deg, 0);
    EXPECT_LT(found_deg, 360);
  }
}

TEST(OrientationDeg, TurnsWithTheImage) {
  const cv::Mat1b upright = Turned(0);
  const std::vector<cv::Point> corners = Corners(upright);
  ASSERT_GT(corners.size(), 50u);
  for (const double angle_deg : {90.0, 180.0, 270.0}) {  // pixels fall onto pixels
    const cv::Mat1b turned = Turned(angle_deg);
    for (const cv::Point& corner : corners) {
      const float before = OrientationDeg(upright, corner);
      const float after = OrientationDeg(turned, Follow(corner, angle_deg));
      EXPECT_LT(Between(after, before + angle_deg), 2) << corner << " by " << angle_deg;
    }
  }
}

TEST(DescribePixels, ATurnedImageLooksTheSame) {
  const cv::Mat1b upright = Turned(0);
  const std::vector<cv::Point> corners = Corners(upright);
  for (const double angle_deg : {20.0, 45.0, 90.0, 135.0, 180.0, 250.0}) {
    const cv::Mat1b turned = Turned(angle_deg);
    std::vector<int> same, other;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Descriptor before = Describe(upright, corners[i]);
      same.push_back(HammingDistance(before, Describe(turned, Follow(corners[i], angle_deg))));
      const cv::Point next = corners[(i + 1) % corners.size()];
      other.push_back(HammingDistance(before, Describe(turned, Follow(next, angle_deg))));
    }
    EXPECT_LT(Median(same), 40) << angle_deg;  // of 256 bits: well within what counts as a match
    EXPECT_GT(Median(other), 80) << angle_deg;
  }
}

}  // namespace
}  // namespace aisle::slam
