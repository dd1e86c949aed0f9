#include "slam/feature/corners.h"

#include <algorithm>
#include <opencv2/features2d.hpp>

namespace aisle::slam {
namespace {

/// FAST reads a circle of radius 3 and needs one more pixel to suppress non-maxima.
constexpr int kFastReach = 4;

/// Whether the image around changes in one direction alone: of its structure tensor (Harris and
/// Stephens 1988) the eigenvalues' ratio is below `least_ratio`.
bool IsOnEdge(const cv::Mat1b& level, const cv::Point& pixel, double least_ratio) {
  if (least_ratio == 0) return false;
  constexpr int kRadius = 3;  // as FAST's circle; with the differences, kFastReach
  int xx = 0, xy = 0, yy = 0;
  for (int y = pixel.y - kRadius; y <= pixel.y + kRadius; ++y) {
    const std::uint8_t *above = level[y - 1], *row = level[y], *below = level[y + 1];
    for (int x = pixel.x - kRadius; x <= pixel.x + kRadius; ++x) {
      const int by_x = row[x + 1] - row[x - 1], by_y = below[x] - above[x];
      xx += by_x * by_x;
      xy += by_x * by_y;
      yy += by_y * by_y;
    }
  }
  // Of eigenvalues a >= b: b < r a just where (1 + r)^2 a b < r (a + b)^2.
  const double trace = static_cast<double>(xx) + yy;
  const double determinant = static_cast<double>(xx) * yy - static_cast<double>(xy) * xy;
  return (1 + least_ratio) * (1 + least_ratio) * determinant < least_ratio * trace * trace;
}

/// Corners inside `area` of the level, which lies at least kFastReach from the image's edge.
void AppendCorners(const cv::Mat1b& level, const cv::Rect& area, int threshold,
                   double least_corner_ratio, std::vector<Corner>& corners) {
  const cv::Rect reach(area.x - kFastReach, area.y - kFastReach, area.width + 2 * kFastReach,
                       area.height + 2 * kFastReach);
  std::vector<cv::KeyPoint> found;
  cv::FAST(level(reach), found, threshold, true);
  for (const cv::KeyPoint& keypoint : found) {
    const cv::Point pixel(static_cast<int>(keypoint.pt.x) + reach.x,
                          static_cast<int>(keypoint.pt.y) + reach.y);
    if (area.contains(pixel) && !IsOnEdge(level, pixel, least_corner_ratio))
      corners.push_back({pixel.x, pixel.y, keypoint.response});
  }
}

}  // namespace

std::vector<Corner> DetectCorners(const cv::Mat1b& level, const FeatureOptions& options) {
  const int border = std::max(options.border_px, kFastReach);
  const cv::Rect area(border, border, level.cols - 2 * border, level.rows - 2 * border);
  std::vector<Corner> corners;
  if (area.width <= 0 || area.height <= 0) return corners;
  AppendCorners(level, area, options.fast_threshold, options.least_corner_ratio,
                corners);  // in rising order already
  const auto strong = std::ssize(corners);

  const int columns = std::max(1, area.width / options.cell_px);
  const int rows = std::max(1, area.height / options.cell_px);
  std::vector<char> occupied(static_cast<std::size_t>(columns * rows), 0);
  const auto column_of = [&](int x) { return (x - area.x) * columns / area.width; };
  const auto row_of = [&](int y) { return (y - area.y) * rows / area.height; };
  for (const Corner& corner : corners) {
    occupied[static_cast<std::size_t>(row_of(corner.y) * columns + column_of(corner.x))] = 1;
  }
  // The first pixel of a cell is the first that the division above gives to it.
  const auto first = [](int cell, int cells, int extent) {
    return (cell * extent + cells - 1) / cells;
  };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      if (occupied[static_cast<std::size_t>(row * columns + column)]) continue;
      const int x = first(column, columns, area.width), y = first(row, rows, area.height);
      const cv::Rect cell(area.x + x, area.y + y, first(column + 1, columns, area.width) - x,
                          first(row + 1, rows, area.height) - y);
      AppendCorners(level, cell, options.fast_threshold_low, options.least_corner_ratio, corners);
    }
  }
  const auto upper_left = [](const Corner& a, const Corner& b) {
    return std::tie(a.y, a.x) < std::tie(b.y, b.x);
  };
  std::sort(corners.begin() + strong, corners.end(), upper_left);
  std::inplace_merge(corners.begin(), corners.begin() + strong, corners.end(), upper_left);
  return corners;
}

}  // namespace aisle::slam
