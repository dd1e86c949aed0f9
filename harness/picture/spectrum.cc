#include "harness/picture/spectrum.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace aisle {
namespace {

constexpr int kTile = 256;

/// Tiles that overlap by half have all pixels under windows that sum to 1. OpenCV's own window of
/// that name is the root of the product of two.
cv::Mat1f HannWindow() {
  cv::Mat1f row(1, kTile);
  for (int x = 0; x < kTile; ++x) {
    row(x) = static_cast<float>(0.5 - 0.5 * std::cos(2 * std::numbers::pi * x / kTile));
  }
  return cv::Mat1f(row.t() * row);
}

/// Adds a tile's power to its rings and counts what was added.
void AddTile(const cv::Mat1f& tile, std::vector<double>* power, std::vector<double>* count) {
  cv::Mat2f transform;
  cv::dft(tile, transform, cv::DFT_COMPLEX_OUTPUT);
  for (int v = 0; v < kTile; ++v) {
    for (int u = 0; u < kTile; ++u) {
      const double fu = u <= kTile / 2 ? u : u - kTile, fv = v <= kTile / 2 ? v : v - kTile;
      const auto ring = static_cast<std::size_t>(std::lround(std::hypot(fu, fv)));
      if (ring == 0 || ring >= power->size()) continue;
      const cv::Vec2f value = transform(v, u);
      (*power)[ring] += double{value[0]} * double{value[0]} + double{value[1]} * double{value[1]};
      (*count)[ring] += 1;
    }
  }
}

}  // namespace

std::vector<double> PowerSpectrum(const cv::Mat1b& image) {
  if (image.rows < kTile || image.cols < kTile) return {};
  const cv::Mat1f window = HannWindow();
  std::vector<double> power(kTile / 2 + 1), count(kTile / 2 + 1);
  for (int y = 0; y + kTile <= image.rows; y += kTile / 2) {
    for (int x = 0; x + kTile <= image.cols; x += kTile / 2) {
      cv::Mat1f tile;
      image(cv::Rect(x, y, kTile, kTile)).convertTo(tile, CV_32F);
      tile -= cv::mean(tile)[0];
      AddTile(cv::Mat1f(tile.mul(window)), &power, &count);
    }
  }
  for (std::size_t i = 1; i < power.size(); ++i) power[i] /= count[i];
  return power;
}

double SpectrumSlope(const std::vector<double>& spectrum, double from, double to) {
  double n = 0, x_sum = 0, y_sum = 0, xx_sum = 0, xy_sum = 0;
  for (std::size_t i = 1; i < spectrum.size(); ++i) {
    const double frequency = static_cast<double>(i) / kTile;
    if (frequency < from || frequency > to || spectrum[i] <= 0) continue;
    const double x = std::log(frequency), y = std::log(spectrum[i]);
    n += 1;
    x_sum += x;
    y_sum += y;
    xx_sum += x * x;
    xy_sum += x * y;
  }
  if (n < 2) return std::numeric_limits<double>::quiet_NaN();
  return (n * xy_sum - x_sum * y_sum) / (n * xx_sum - x_sum * x_sum);
}

}  // namespace aisle
