#include "slam/dynamic/robust/label_memory.h"

#include <limits>

#include "slam/common/parallel.h"
#include "slam/dynamic/robust/earlier_disparity.h"
#include "slam/dynamic/robust/monocular.h"

namespace aisle::slam::dynamic {
namespace {

/// Which pixel around a place shows the same surface. A step to the side counts as much as a
/// deviation of the disparity: what lies on the spot is preferred to what is as good beside it.
struct Surface {
  EarlierDisparity disparity;
  float tolerance, per_step;

  Surface(float now, float if_static, const DisparityTolerance& rule)
      : disparity(now, if_static), tolerance(2 * rule.At(now)), per_step(rule.noise()) {}

  /// How far a pixel of another disparity, so many steps away, is from being that; endlessly where
  /// its disparity is unknown (negative).
  float Difference(float other, int steps) const {
    const float off = disparity.DistanceTo(other) + per_step * static_cast<float>(steps);
    return other < 0 ? std::numeric_limits<float>::infinity() : off;
  }
};

/// SameSurface in the midst of the image: all nine, without branches.
cv::Point SameSurfaceInside(const cv::Mat1f& disparity, cv::Point centre, const Surface& surface) {
  float least = surface.tolerance;
  int best = -1;
  for (int row = 0; row < 3; ++row) {
    const float* at = disparity[centre.y + row - 1] + centre.x - 1;
    for (int column = 0; column < 3; ++column) {
      const float off = surface.Difference(at[column], std::abs(column - 1) + std::abs(row - 1));
      best = off < least ? 3 * row + column : best;
      least = off < least ? off : least;
    }
  }
  return best < 0 ? cv::Point(-1, -1) : centre + cv::Point(best % 3 - 1, best / 3 - 1);
}

/// The pixel around a place whose disparity is closest, places further off counting as less close;
/// outside the image if none is close enough.
cv::Point SameSurface(const cv::Mat1f& disparity, const cv::Vec2f& place, const Surface& surface) {
  const cv::Point centre(cvRound(place[0]), cvRound(place[1]));
  const cv::Rect image({0, 0}, disparity.size());
  const cv::Rect inner(1, 1, disparity.cols - 2, disparity.rows - 2);
  if (image.contains(centre) &&
      surface.Difference(disparity(centre), 0) < std::min(surface.tolerance, surface.per_step)) {
    return centre;
  }
  if (inner.contains(centre)) return SameSurfaceInside(disparity, centre, surface);
  cv::Point best(-1, -1);
  float least = surface.tolerance;
  const cv::Rect around = cv::Rect(centre.x - 1, centre.y - 1, 3, 3) & image;
  for (int y = around.y; y < around.y + around.height; ++y) {
    for (int x = around.x; x < around.x + around.width; ++x) {
      const float off =
          surface.Difference(disparity(y, x), std::abs(x - centre.x) + std::abs(y - centre.y));
      if (off >= least) continue;
      least = off;
      best = {x, y};
    }
  }
  return best;
}

/// The pixel at a place; outside the image (-1, -1).
cv::Point PixelAt(const cv::Vec2f& place, cv::Size size) {
  const cv::Point pixel(cvRound(place[0]), cvRound(place[1]));
  return cv::Rect({0, 0}, size).contains(pixel) ? pixel : cv::Point(-1, -1);
}

constexpr int kNowhere = -1;

/// What leads pixels back to the frame before, see CarryMemory.
struct WayBack {
  const cv::Mat2f& flow;
  const cv::Mat1f& if_static;
  const DenseFrame &now, &before;
  const DisparityTolerance& tolerance;
};

/// Where the pixels of a row were in the frame before: numbers of pixels in raster order.
void FindSources(const WayBack& way, int y, std::vector<int>& sources) {
  const auto& [flow, if_static, now, before, tolerance] = way;
  const float *disparity = now.disparity[y], *filled = now.filled[y], *then = if_static[y];
  const cv::Vec2f* places = flow[y];
  const int monocular = MonocularColumns(disparity, flow.cols);
  for (int x = 0; x < flow.cols; ++x) {
    // Who leaves to the left is known no less where the right camera loses him first.
    const bool flow_alone = x < monocular && disparity[x] <= 0;
    const Surface surface(filled[x], then[x], tolerance);
    const cv::Point from = flow_alone ? PixelAt(places[x], flow.size())
                                      : SameSurface(before.disparity, places[x], surface);
    sources[static_cast<std::size_t>(x)] = from.x < 0 ? kNowhere : from.y * flow.cols + from.x;
  }
}

/// A row of what was known there, and nothing where that is nowhere.
template <typename Known>
void Take(const cv::Mat_<Known>& before, const std::vector<int>& sources, Known* row) {
  CV_Assert(before.isContinuous());
  const Known* known = before[0];
  for (std::size_t x = 0; x < sources.size(); ++x) {
    row[x] = sources[x] == kNowhere ? Known() : known[sources[x]];
  }
}

}  // namespace

LabelMemory ForgottenMemory(cv::Size size, int next_region_id) {
  return {cv::Mat1f(size, 0.0F), {cv::Mat1i(size, 0), {}, next_region_id}, {}, {}};
}

LabelMemory CarryMemory(const LabelMemory& previous, const cv::Mat2f& flow,
                        const cv::Mat1f& if_static, const DenseFrame& now, const DenseFrame& before,
                        const DisparityTolerance& tolerance) {
  if (previous.log_odds.empty()) return ForgottenMemory(flow.size(), previous.regions.next_id);
  const cv::Size size = flow.size();
  LabelMemory carried{cv::Mat1f(size),
                      {cv::Mat1i(size), previous.regions.regions, previous.regions.next_id}};
  const bool compared_long = !previous.long_log_odds.empty();
  if (compared_long) {
    carried.long_log_odds.create(size);
    carried.long_per_step.create(size);
  }
  ParallelFor(0, flow.rows, [&](int y) {
    std::vector<int> sources(static_cast<std::size_t>(flow.cols));
    FindSources({flow, if_static, now, before, tolerance}, y, sources);
    Take(previous.log_odds, sources, carried.log_odds[y]);
    Take(previous.regions.labels, sources, carried.regions.labels[y]);
    if (!compared_long) return;
    Take(previous.long_log_odds, sources, carried.long_log_odds[y]);
    Take(previous.long_per_step, sources, carried.long_per_step[y]);
  });
  return carried;
}

}  // namespace aisle::slam::dynamic
