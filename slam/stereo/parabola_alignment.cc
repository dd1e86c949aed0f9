#include "slam/stereo/parabola_alignment.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace aisle::slam {
namespace {

bool Holds(const cv::Mat1b& image, cv::Point centre, int reach_x, int reach_y) {
  return centre.x >= reach_x && centre.x + reach_x < image.cols && centre.y >= reach_y &&
         centre.y + reach_y < image.rows;
}

/// Sum of absolute differences of two squares, each less its central pixel.
int Difference(const cv::Mat1b& left, cv::Point at_left, const cv::Mat1b& right, cv::Point at_right,
               int radius) {
  const int offset = left(at_left) - right(at_right);
  int sum = 0;
  for (int dy = -radius; dy <= radius; ++dy) {
    const std::uint8_t* a = left.ptr(at_left.y + dy) + at_left.x;
    const std::uint8_t* b = right.ptr(at_right.y + dy) + at_right.x;
    for (int dx = -radius; dx <= radius; ++dx) sum += std::abs(a[dx] - b[dx] - offset);
  }
  return sum;
}

}  // namespace

std::optional<RowAlignment> AlignByParabola(const cv::Mat1b& left, cv::Point2d left_pixel,
                                            const cv::Mat1b& right, double right_column,
                                            const StereoOptions& options) {
  const int radius = options.patch_radius_px, reach = options.search_px, side = 2 * radius + 1;
  const cv::Point here(static_cast<int>(std::lround(left_pixel.x)),
                       static_cast<int>(std::lround(left_pixel.y)));
  const cv::Point start(static_cast<int>(std::lround(right_column)), here.y);
  if (!Holds(left, here, radius, radius) || !Holds(right, start, radius + reach, radius)) {
    return std::nullopt;
  }
  std::vector<int> sums;
  for (int step = -reach; step <= reach; ++step) {
    sums.push_back(Difference(left, here, right, start + cv::Point(step, 0), radius));
  }
  const auto best = std::ranges::min_element(sums) - sums.begin();
  if (best == 0 || best == 2 * reach) return std::nullopt;
  const auto at = [&](std::ptrdiff_t i) { return sums[static_cast<std::size_t>(i)]; };
  const double before = at(best - 1), least = at(best), after = at(best + 1);
  const double delta = (before - after) / (2 * (before + after - 2 * least));
  if (!(std::abs(delta) <= 1)) return std::nullopt;  // also where all three are equal
  // The corner lies off its whole pixel by as much in either camera.
  const double off = left_pixel.x - here.x;
  return RowAlignment{start.x + static_cast<double>(best - reach) + delta + off, 0,
                      least / (side * side)};
}

}  // namespace aisle::slam
