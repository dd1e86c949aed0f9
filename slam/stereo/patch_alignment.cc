#include "slam/stereo/patch_alignment.h"

#include <Eigen/Core>
#include <cmath>

namespace aisle::slam {
namespace {

/// No patch is larger, so that none needs the heap.
constexpr int kLargest = 21;
using Patch =
    Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, kLargest, kLargest + 2>;

/// `columns` x `rows` samples from (x, y) on, bilinear; the caller keeps them inside the image.
Patch Sample(const cv::Mat1b& image, double x, double y, int columns, int rows) {
  const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
  const double a = x - left, b = y - top;
  Patch patch(rows, columns);
  for (int row = 0; row < rows; ++row) {
    const std::uint8_t* upper = image.ptr(top + row) + left;
    const std::uint8_t* lower = image.ptr(top + row + (b > 0 ? 1 : 0)) + left;
    for (int column = 0; column < columns; ++column) {
      const int next = column + (a > 0 ? 1 : 0);
      patch(row, column) = (1 - b) * ((1 - a) * upper[column] + a * upper[next]) +
                           b * ((1 - a) * lower[column] + a * lower[next]);
    }
  }
  return patch;
}

bool Holds(const cv::Mat1b& image, double x, double y, int columns, int rows) {
  return x >= 0 && y >= 0 && x + columns < image.cols && y + rows < image.rows;
}

}  // namespace

std::optional<RowAlignment> AlignAlongRow(const cv::Mat1b& left, cv::Point2d left_pixel,
                                          const cv::Mat1b& right, double right_column,
                                          const StereoOptions& options) {
  const int radius = options.patch_radius_px, side = 2 * radius + 1;
  const double top = left_pixel.y - radius;
  // One column more on either side of the template, for its gradient.
  if (!Holds(left, left_pixel.x - radius - 1, top, side + 2, side)) return std::nullopt;
  const Patch wide = Sample(left, left_pixel.x - radius - 1, top, side + 2, side);
  const Patch centre = wide.middleCols(1, side);
  const Patch model = centre - centre.mean();
  const Patch gradient = 0.5 * (wide.rightCols(side) - wide.leftCols(side));
  const double gradient_energy = (gradient - gradient.mean()).square().sum();
  if (gradient_energy < 1.0) return std::nullopt;

  const auto sampled = [&](double column) -> std::optional<Patch> {
    if (!Holds(right, column - radius, top, side, side)) return std::nullopt;
    Patch patch = Sample(right, column - radius, top, side, side);
    patch -= patch.mean();
    return patch;
  };
  // Whole steps from a start that shares the template's fraction, so that both are blurred alike.
  const double fraction = left_pixel.x - std::floor(left_pixel.x);
  const double start = std::round(right_column - fraction) + fraction;
  int best = 0;
  double least = -1;
  for (int step = -options.search_px; step <= options.search_px; ++step) {
    const std::optional<Patch> patch = sampled(start + step);
    if (!patch) continue;
    const double difference = (*patch - model).abs().sum();
    if (least < 0 || difference < least) least = difference, best = step;
  }
  if (least < 0 || std::abs(best) == options.search_px) return std::nullopt;

  double column = start + best;
  constexpr int kIterations = 5;
  for (int i = 0; i < kIterations; ++i) {
    const std::optional<Patch> patch = sampled(column);
    if (!patch) return std::nullopt;
    const double step = ((model - *patch) * gradient).sum() / gradient_energy;
    column += std::clamp(step, -1.0, 1.0);
    if (std::abs(step) < 0.005) break;
  }
  // Least squares has left the best whole column: the patch is not one surface.
  if (std::abs(column - (start + best)) > 1.0) return std::nullopt;
  const std::optional<Patch> patch = sampled(column);
  if (!patch) return std::nullopt;
  // Both images are noisy: twice the variance of one.
  return RowAlignment{column, options.image_noise * std::sqrt(2.0 / gradient_energy),
                      (*patch - model).abs().mean()};
}

}  // namespace aisle::slam
