#include "slam/dynamic/label_memory.h"

#include <tbb/parallel_for.h>

namespace aisle::slam::dynamic {
namespace {

/// The pixel around a place whose disparity is closest, places further off counting as less close;
/// outside the image if none is close enough.
cv::Point SameSurface(const cv::Mat1f& disparity, const cv::Vec2f& place, float d) {
  constexpr float kTolerance = 0.5F, kToleranceShare = 0.08F, kPerPixel = 0.1F;
  cv::Point best(-1, -1);
  float least = kTolerance + kToleranceShare * d;
  const int cx = cvRound(place[0]), cy = cvRound(place[1]);
  const bool inside = cx >= 0 && cy >= 0 && cx < disparity.cols && cy < disparity.rows;
  if (inside && std::abs(disparity(cy, cx) - d) < std::min(least, kPerPixel)) return {cx, cy};
  for (int y = std::max(cy - 1, 0); y <= std::min(cy + 1, disparity.rows - 1); ++y) {
    for (int x = std::max(cx - 1, 0); x <= std::min(cx + 1, disparity.cols - 1); ++x) {
      const float off = std::abs(disparity(y, x) - d) +
                        kPerPixel * static_cast<float>(std::abs(x - cx) + std::abs(y - cy));
      if (off >= least) continue;
      least = off;
      best = {x, y};
    }
  }
  return best;
}

}  // namespace

LabelMemory ForgottenMemory(cv::Size size) {
  return {cv::Mat1f(size, 0.0F), {cv::Mat1i(size, 0), {}}, {}, {}};
}

LabelMemory CarryMemory(const LabelMemory& previous, const cv::Mat2f& flow, const DenseFrame& now,
                        const DenseFrame& before) {
  LabelMemory carried = ForgottenMemory(flow.size());
  if (previous.log_odds.empty()) return carried;
  carried.regions.regions = previous.regions.regions;
  const bool compared_long = !previous.long_log_odds.empty();
  if (compared_long) {
    carried.long_log_odds = cv::Mat1f(flow.size(), 0.0F);
    carried.long_per_step = cv::Mat2f(flow.size(), cv::Vec2f(0, 0));
  }
  tbb::parallel_for(0, flow.rows, [&](int y) {
    for (int x = 0; x < flow.cols; ++x) {
      const cv::Point from = SameSurface(before.disparity, flow(y, x), now.filled(y, x));
      if (from.x < 0) continue;
      carried.log_odds(y, x) = previous.log_odds(from);
      if (compared_long) {
        carried.long_log_odds(y, x) = previous.long_log_odds(from);
        carried.long_per_step(y, x) = previous.long_per_step(from);
      }
      carried.regions.labels(y, x) = previous.regions.labels(from);
    }
  });
  return carried;
}

}  // namespace aisle::slam::dynamic
