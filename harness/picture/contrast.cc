#include "harness/picture/contrast.h"

#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "harness/picture/tones.h"
#include "harness/score/statistics.h"

namespace aisle {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr int kContrastBlock = 16, kPlainBlock = 8;
constexpr double kPlainShare = 0.1;

/// All whole blocks of the picture, row by row.
std::vector<cv::Mat1b> Blocks(const cv::Mat1b& image, int size) {
  std::vector<cv::Mat1b> blocks;
  for (int y = 0; y + size <= image.rows; y += size) {
    for (int x = 0; x + size <= image.cols; x += size) {
      blocks.push_back(image(cv::Rect(x, y, size, size)));
    }
  }
  return blocks;
}

double QuantileOrNothing(const std::vector<double>& values, double q) {
  return values.empty() ? kNothing : Quantile(values, q);
}

cv::Rect WithoutBorder(const cv::Mat& image) {
  return cv::Rect(1, 1, image.cols - 2, image.rows - 2) & cv::Rect({}, image.size());
}

}  // namespace

double MedianGradient(const cv::Mat1b& image) {
  cv::Mat1f across, down;
  cv::Sobel(image, across, CV_32F, 1, 0, 3, 1.0 / 8);
  cv::Sobel(image, down, CV_32F, 0, 1, 3, 1.0 / 8);
  cv::Mat1f magnitude;
  cv::magnitude(across, down, magnitude);
  const cv::Mat1f inner = magnitude(WithoutBorder(magnitude));
  return QuantileOrNothing({inner.begin(), inner.end()}, 0.5);
}

double LocalContrast(const cv::Mat1b& image) {
  std::vector<double> contrasts;
  for (const cv::Mat1b& block : Blocks(image, kContrastBlock)) {
    cv::Scalar mean, deviation;
    cv::meanStdDev(block, mean, deviation);
    if (mean[0] > 0) contrasts.push_back(deviation[0] / mean[0]);
  }
  return QuantileOrNothing(contrasts, 0.5);
}

double PlainDeviation(const cv::Mat1b& image) {
  std::vector<double> deviations;
  for (const cv::Mat1b& block : Blocks(image, kPlainBlock)) {
    double least = 0, most = 0;
    cv::minMaxLoc(block, &least, &most);
    if (least <= kBlack || most >= kWhite) continue;
    cv::Scalar mean, deviation;
    cv::meanStdDev(block, mean, deviation);
    deviations.push_back(deviation[0]);
  }
  return QuantileOrNothing(deviations, kPlainShare);
}

double LaplacianVariance(const cv::Mat1b& image) {
  cv::Mat1f laplacian;
  cv::Laplacian(image, laplacian, CV_32F, 1);
  cv::Scalar mean, deviation;
  cv::meanStdDev(laplacian(WithoutBorder(laplacian)), mean, deviation);
  return deviation[0] * deviation[0];
}

}  // namespace aisle
