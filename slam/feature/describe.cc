#include "slam/feature/describe.h"

#include <cmath>
#include <cstring>
#include <numbers>
#include <opencv2/features2d.hpp>
#include <stdexcept>

namespace aisle::slam {
namespace {

constexpr int kRadius = 15;

/// Half the disc's width at each row's distance from the centre.
constexpr std::array<int, kRadius + 1> kHalfWidth = [] {
  std::array<int, kRadius + 1> half_width{};
  for (int y = 0; y <= kRadius; ++y) {
    int x = 0;
    while ((x + 1) * (x + 1) + y * y <= kRadius * kRadius + kRadius) ++x;
    half_width[static_cast<std::size_t>(y)] = std::min(x, kRadius);
  }
  return half_width;
}();

}  // namespace

float OrientationDeg(const cv::Mat1b& level, cv::Point pixel) {
  int moment_x = 0, moment_y = 0;
  for (int y = -kRadius; y <= kRadius; ++y) {
    const std::uint8_t* row = level.ptr(pixel.y + y) + pixel.x;
    const int half_width = kHalfWidth[static_cast<std::size_t>(std::abs(y))];
    int sum = 0;
    for (int x = -half_width; x <= half_width; ++x) {
      moment_x += x * row[x];
      sum += row[x];
    }
    moment_y += y * sum;
  }
  const double angle = std::atan2(moment_y, moment_x) * 180.0 / std::numbers::pi;
  return static_cast<float>(angle < 0 ? angle + 360.0 : angle);
}

std::vector<Descriptor> DescribePixels(const cv::Mat1b& level,
                                       const std::vector<OrientedPixel>& pixels) {
  std::vector<cv::KeyPoint> keypoints;
  keypoints.reserve(pixels.size());
  for (const OrientedPixel& pixel : pixels) {
    keypoints.emplace_back(cv::Point2f(pixel.pixel), 31.0f, pixel.angle_deg);
    keypoints.back().octave = 0;
  }
  // One level at a time and no edge: OpenCV then keeps every keypoint, in order.
  const auto orb = cv::ORB::create(static_cast<int>(pixels.size()), 1.2f, 1, 0);
  cv::Mat rows;
  if (!keypoints.empty()) orb->compute(level, keypoints, rows);
  if (keypoints.size() != pixels.size()) {
    throw std::logic_error("cv::ORB dropped a keypoint that lies inside the image");
  }
  std::vector<Descriptor> descriptors(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    std::memcpy(descriptors[i].data(), rows.ptr(static_cast<int>(i)), sizeof(Descriptor));
  }
  return descriptors;
}

}  // namespace aisle::slam
