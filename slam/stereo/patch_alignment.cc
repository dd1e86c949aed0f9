#include "slam/stereo/patch_alignment.h"

#include <Eigen/Core>
#include <cmath>
#include <limits>

namespace aisle::slam {
namespace {

/// No patch is larger, so that none needs the heap.
constexpr int kLargest = 21;
using Patch =
    Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, kLargest, 2 * kLargest>;
using Strip =
    Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kLargest, 2 * kLargest>;

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

/// The whole step from `start` at which the right patch differs least from the left one, each less
/// its mean; nothing where that is the last step either way.
std::optional<int> BestStep(const Patch& left, const cv::Mat1b& right, double start, double row,
                            const StereoOptions& options) {
  const int side = static_cast<int>(left.rows()), radius = side / 2, reach = options.search_px;
  const int width = side + 2 * reach;
  if (!Holds(right, start - radius - reach, row - radius, width, side)) return std::nullopt;
  const Strip strip =
      Sample(right, start - radius - reach, row - radius, width, side).cast<float>();
  const Strip model = (left - left.mean()).cast<float>();
  int best = -reach;
  float least = std::numeric_limits<float>::max();
  for (int step = -reach; step <= reach; ++step) {
    const auto patch = strip.middleCols(step + reach, side);
    const float difference = (patch - patch.mean() - model).abs().sum();
    if (difference < least) least = difference, best = step;
  }
  if (std::abs(best) == reach) return std::nullopt;
  return best;
}

/// How a square of the left image lies in the right one: where its centre's column is, and how much
/// further each pixel lies per pixel right of and below the centre (a slanted surface).
struct Warp {
  double column = 0, per_column = 0, per_row = 0;
};

/// The square around (warp.column, row) of the right image, seen as the left camera would, or
/// nothing where it leaves the image.
std::optional<Patch> SampleWarped(const cv::Mat1b& image, const Warp& warp, double row, int side) {
  const int radius = side / 2;
  const double reach = radius * (1 + std::abs(warp.per_column) + std::abs(warp.per_row)) + 1;
  if (warp.column < reach || warp.column + reach >= image.cols) return std::nullopt;
  if (row < radius || row + radius + 1 >= image.rows) return std::nullopt;
  const int top = static_cast<int>(std::floor(row));
  const double b = row - top;
  Patch patch(side, side);
  for (int dy = -radius; dy <= radius; ++dy) {
    const std::uint8_t* upper = image.ptr(top + dy);
    const std::uint8_t* lower = image.ptr(top + dy + 1);
    double x = warp.column + warp.per_row * dy - (1 + warp.per_column) * radius;
    for (int column = 0; column < side; ++column, x += 1 + warp.per_column) {
      const int i = static_cast<int>(x);
      const double a = x - i;
      patch(dy + radius, column) = (1 - b) * ((1 - a) * upper[i] + a * upper[i + 1]) +
                                   b * ((1 - a) * lower[i] + a * lower[i + 1]);
    }
  }
  return patch;
}

struct Shift {
  Warp warp;
  double sigma, mismatch;
};

/// Lucas-Kanade over column and slants, the slants held near zero by what surfaces usually do.
std::optional<Shift> RefineShift(const Patch& model, const Patch& gradient, const cv::Mat1b& right,
                                 Warp warp, double row, const StereoOptions& options) {
  const int side = static_cast<int>(model.rows()), radius = side / 2;
  // Columns: how the patch changes with the warp's three numbers, and with brightness.
  Eigen::Matrix<double, Eigen::Dynamic, 4, 0, kLargest * kLargest, 4> J(side * side, 4);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double g = gradient(y, x);
      J.row(y * side + x) << g, g * (x - radius), g * (y - radius), 1;
    }
  }
  const double variance = 2 * options.image_noise * options.image_noise;  // both images are noisy
  Eigen::Matrix4d H = J.transpose() * J;
  H.diagonal().segment<2>(1).array() += variance / (options.usual_slant * options.usual_slant);
  const Eigen::Matrix4d inverse = H.inverse();
  Eigen::Array<double, Eigen::Dynamic, 1, 0, kLargest * kLargest> difference(side * side);
  constexpr int kIterations = 6;
  for (int i = 0; i < kIterations; ++i) {
    const std::optional<Patch> patch = SampleWarped(right, warp, row, side);
    if (!patch) return std::nullopt;
    for (int y = 0; y < side; ++y) {
      difference.segment(y * side, side) = (model.row(y) - patch->row(y)).transpose();
    }
    Eigen::Vector4d b = J.transpose() * difference.matrix();
    b[1] -= variance / (options.usual_slant * options.usual_slant) * warp.per_column;
    b[2] -= variance / (options.usual_slant * options.usual_slant) * warp.per_row;
    const Eigen::Vector4d step = inverse * b;
    if (!step.allFinite()) return std::nullopt;  // texture in too few directions
    warp.column += std::clamp(step[0], -1.0, 1.0);
    warp.per_column = std::clamp(warp.per_column + step[1], -0.5, 0.5);
    warp.per_row = std::clamp(warp.per_row + step[2], -0.5, 0.5);
    if (std::abs(step[0]) < 0.005) break;
  }
  return Shift{warp, std::sqrt(variance * inverse(0, 0)),
               (difference - difference.mean()).abs().mean()};
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
  const Patch gradient = 0.5 * (wide.rightCols(side) - wide.leftCols(side));
  const double gradient_energy = (gradient - gradient.mean()).square().sum();
  if (gradient_energy < 1.0) return std::nullopt;

  // Whole steps from a start that shares the template's fraction, so that both are blurred alike.
  const double fraction = left_pixel.x - std::floor(left_pixel.x);
  const double start = std::round(right_column - fraction) + fraction;
  const std::optional<int> best = BestStep(centre, right, start, left_pixel.y, options);
  if (!best) return std::nullopt;
  std::optional<Shift> shift =
      RefineShift(centre, gradient, right, {start + *best, 0, 0}, left_pixel.y, options);
  // Least squares has left the best whole column: the patch is not one surface.
  if (!shift || std::abs(shift->warp.column - (start + *best)) > 1.0) return std::nullopt;
  return RowAlignment{shift->warp.column, shift->sigma, shift->mismatch};
}

}  // namespace aisle::slam
