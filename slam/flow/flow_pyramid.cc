#include "slam/flow/flow_pyramid.h"

#include <opencv2/imgproc.hpp>

#include "slam/flow/eight.h"

namespace aisle::slam {
namespace {

static_assert(kFlowPatch == 8, "a row of a patch is an Eight");
constexpr int kStride = 4;

/// Mean of 2x2 pixels each.
cv::Mat1f Halved(const cv::Mat1f& image) {
  cv::Mat1f half(image.rows / 2, image.cols / 2);
  for (int y = 0; y < half.rows; ++y) {
    const float *upper = image[2 * y], *lower = image[2 * y + 1];
    float* to = half[y];
    const int columns = half.cols;
#pragma GCC ivdep
    for (int x = 0; x < columns; ++x) {
      to[x] = ((upper[2 * x] + upper[2 * x + 1]) + (lower[2 * x] + lower[2 * x + 1])) / 4;
    }
  }
  return half;
}

/// First pixels of the patches along a side.
std::vector<int> Starts(int side) {
  std::vector<int> starts;
  for (int at = 0; at < side - kFlowPatch; at += kStride) starts.push_back(at);
  starts.push_back(side - kFlowPatch);
  return starts;
}

FlowPatch MeasurePatch(const FlowLevel& level, int x, int y, float inertia) {
  Eight sum_x{}, sum_y{}, sum_xx{}, sum_xy{}, sum_yy{}, gx, gy;
  for (int row = y; row < y + kFlowPatch; ++row) {
    Load(level.gradient_x[row] + x, gx);
    Load(level.gradient_y[row] + x, gy);
    sum_x += gx;
    sum_y += gy;
    sum_xx += gx * gx;
    sum_xy += gx * gy;
    sum_yy += gy * gy;
  }
  constexpr float kArea = kFlowPatch * kFlowPatch;
  FlowPatch patch{x, y, Sum(sum_x), Sum(sum_y), 0, 0, 0};
  const float xx = Sum(sum_xx) - patch.sum_x * patch.sum_x / kArea + inertia;
  const float xy = Sum(sum_xy) - patch.sum_x * patch.sum_y / kArea;
  const float yy = Sum(sum_yy) - patch.sum_y * patch.sum_y / kArea + inertia;
  const float determinant = xx * yy - xy * xy;
  patch.xx = yy / determinant;
  patch.xy = -xy / determinant;
  patch.yy = xx / determinant;
  return patch;
}

FlowLevel MakeLevel(const cv::Mat1f& image, float inertia) {
  constexpr double kSobelGain = 1.0 / 8;
  FlowLevel level{image, {}, {}, {}};
  cv::Sobel(image, level.gradient_x, CV_32F, 1, 0, 3, kSobelGain, 0, cv::BORDER_REPLICATE);
  cv::Sobel(image, level.gradient_y, CV_32F, 0, 1, 3, kSobelGain, 0, cv::BORDER_REPLICATE);
  for (const int y : Starts(image.rows)) {
    for (const int x : Starts(image.cols)) {
      level.patches.push_back(MeasurePatch(level, x, y, inertia));
    }
  }
  return level;
}

}  // namespace

std::vector<cv::Mat1f> HalvedAgainAndAgain(const cv::Mat1b& image,
                                           const DenseFlowOptions& options) {
  constexpr int kLeastSide = 2 * kFlowPatch - 2;
  cv::Mat1f level;
  image.convertTo(level, CV_32F);
  std::vector<cv::Mat1f> levels;
  for (int scale = 0; std::min(level.rows, level.cols) >= kLeastSide; ++scale) {
    if (scale >= options.finest_scale) levels.push_back(level);
    level = Halved(level);
  }
  return levels;
}

FlowPyramid MakeFlowPyramid(const cv::Mat1b& image, const DenseFlowOptions& options) {
  FlowPyramid pyramid;
  for (const cv::Mat1f& level : HalvedAgainAndAgain(image, options)) {
    pyramid.push_back(MakeLevel(level, static_cast<float>(options.inertia)));
  }
  return pyramid;
}

}  // namespace aisle::slam
