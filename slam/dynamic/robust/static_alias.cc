#include "slam/dynamic/robust/static_alias.h"

#include <array>

#include "slam/stereo/dense/semi_global_options.h"

namespace aisle::slam::dynamic {
namespace {

constexpr int kHalfWindow = 3, kWindow = 2 * kHalfWindow + 1;
constexpr float kUnknown = 1e6F;  // larger than any squared difference

/// Squared differences between the window around a pixel and those of the right image at each
/// disparity, as far as the half pixel around cannot explain them (Birchfield and Tomasi, 1998).
/// Each difference is cut so that their sum fits.
class StereoDifferences {
 public:
  /// For disparities of [0, count), of which windows within the right image are fewer.
  StereoDifferences(const DenseFrame& frame, cv::Point at, int count)
      : count_(std::min(count, at.x - kHalfWindow + 1)) {
    if (count_ <= 0) return;
    const int first = at.x - count_ + 1 - kHalfWindow;  // column of the farthest window's left edge
    std::fill(sums_.begin(), sums_.begin() + count_, std::uint16_t{0});
    for (int v = -kHalfWindow; v <= kHalfWindow; ++v) {
      const unsigned char* seen = frame.image[at.y + v] + at.x - kHalfWindow;
      for (int u = 0; u < kWindow; ++u) {
        Add(seen[u], frame.right_low[at.y + v] + first + u, frame.right_high[at.y + v] + first + u);
      }
    }
  }

  int count() const { return count_; }
  int operator[](int disparity) const {
    return sums_[static_cast<std::size_t>(count_ - 1 - disparity)];
  }
  /// Whether neither neighbour fits better.
  bool IsValley(int disparity) const {
    const int here = (*this)[disparity];
    return (disparity == 0 || here <= (*this)[disparity - 1]) &&
           (disparity + 1 == count_ || here <= (*this)[disparity + 1]);
  }

 private:
  void Add(unsigned char grey, const unsigned char* low, const unsigned char* high) {
    constexpr int kMostDifference = 36;  // 49 squares of it fit
    const auto seen = static_cast<std::int16_t>(grey);
    std::uint16_t* sums = sums_.data();
#pragma GCC ivdep
    for (int k = 0; k < count_; ++k) {
      const auto above = static_cast<std::int16_t>(seen - high[k]);
      const auto below = static_cast<std::int16_t>(low[k] - seen);
      std::int16_t off = above > below ? above : below;
      off = off > 0 ? off : std::int16_t{0};
      off = off < kMostDifference ? off : std::int16_t{kMostDifference};
      sums[k] = static_cast<std::uint16_t>(sums[k] + off * off);
    }
  }

  int count_;
  std::array<std::uint16_t, kMostDisparities> sums_;  // the largest disparity first
};

/// Squared differences between the window around a pixel and the earlier image's around a place
/// between pixels, cut like those of stereo; exact only up to `most`. Endless outside.
int DifferenceInTime(const cv::Mat1b& now, const cv::Mat1b& then, cv::Point at,
                     const cv::Vec2f& place, int most) {
  constexpr int kParts = 16, kMostDifference = 36;
  const int left = cvFloor(place[0]), top = cvFloor(place[1]);
  if (left < kHalfWindow || top < kHalfWindow || left + kHalfWindow + 1 >= then.cols ||
      top + kHalfWindow + 1 >= then.rows) {
    return std::numeric_limits<int>::max();
  }
  const int fu = static_cast<int>((place[0] - static_cast<float>(left)) * kParts),
            fv = static_cast<int>((place[1] - static_cast<float>(top)) * kParts);
  int squares = 0;
  for (int v = -kHalfWindow; v <= kHalfWindow && squares < most; ++v) {
    const unsigned char *upper = then[top + v] + left - kHalfWindow,
                        *lower = then[top + v + 1] + left - kHalfWindow,
                        *seen = now[at.y + v] + at.x - kHalfWindow;
    for (int u = 0; u < kWindow; ++u) {
      const int above = (kParts - fu) * upper[u] + fu * upper[u + 1],
                below = (kParts - fu) * lower[u] + fu * lower[u + 1];
      const int grey = ((kParts - fv) * above + fv * below + kParts * kParts / 2) / kParts / kParts;
      const int off = std::min(std::abs(grey - seen[u]), kMostDifference);
      squares += off * off;
    }
  }
  return squares;
}

/// Where the pixel would be in the earlier image, were it static at another disparity.
cv::Vec2f PlaceAt(const SeenMotion& seen, float disparity, float depth_per_disparity) {
  const float depth = seen.disparity / seen.expected_disparity;  // z of its ray, over its own then
  const float farther = disparity - seen.disparity;
  const float depth_there = depth + depth_per_disparity * farther;
  constexpr float kLeastDepth = 0.05F;
  if (depth_there < kLeastDepth) return {-1, -1};
  return seen.expected + farther * depth / depth_there * seen.per_disparity;
}

/// The disparities around one that stereo prefers, so closely that the place leaves no gap.
struct Steps {
  int count;
  float first, step;
};
Steps StepsAround(int disparity, const cv::Vec2f& per_disparity) {
  constexpr float kLargestStep = 0.7F;  // pixels
  constexpr int kMost = 7;
  const float way = std::sqrt(per_disparity.dot(per_disparity));
  const int count = std::clamp(static_cast<int>(std::ceil(way / kLargestStep)), 1, kMost);
  const float step = 1 / static_cast<float>(count);
  return {count, static_cast<float>(disparity) - 0.5F + step / 2, step};
}

}  // namespace

float GainPerDifference(float difference, const EvidenceOptions& options) {
  return static_cast<float>(options.independent_pixels) / 2 /
         (1 + static_cast<float>(options.difference_weight) * difference);
}

float LimitByAlias(const AliasViews& views, const SeenMotion& seen, float log_odds,
                   const EvidenceOptions& options) {
  constexpr float kLeastWay = 0.1F;  // pixels that tell one place from another: twice flow's noise
  CV_Assert(views.disparities <= kMostDisparities);
  const cv::Mat1b& now = views.now.image;
  const float reach =
      static_cast<float>(views.disparities) * std::sqrt(seen.per_disparity.dot(seen.per_disparity));
  if (reach < kLeastWay) return log_odds;
  // The window lies within the image.
  const cv::Point at(std::clamp(seen.at.x, kHalfWindow, now.cols - kHalfWindow - 1),
                     std::clamp(seen.at.y, kHalfWindow, now.rows - kHalfWindow - 1));
  const cv::Vec2f shift(static_cast<float>(at.x - seen.at.x), static_cast<float>(at.y - seen.at.y));
  const StereoDifferences stereo(views.now, at, views.disparities);
  const int own = cvRound(seen.disparity);
  if (own >= stereo.count()) return log_odds;
  const int in_time =
      DifferenceInTime(now, views.then, at, seen.flow + shift, std::numeric_limits<int>::max());
  if (in_time == std::numeric_limits<int>::max()) return log_odds;

  const float unit = kWindow * kWindow * views.variance(seen.at);
  const float moving = static_cast<float>(stereo[own] + in_time) / unit;
  const float gain = GainPerDifference(moving, options);
  const int enough = static_cast<int>(std::min((moving + log_odds / gain) * unit, kUnknown));
  int best = enough;
  for (int k = 0; k < stereo.count(); ++k) {
    if (stereo[k] >= best) continue;
    // What runs along the rows fits a whole range of disparities without a valley in it.
    if (!stereo.IsValley(k) && stereo[k] > stereo[own]) continue;
    if (!views.tolerance.IsOther(seen.disparity, static_cast<float>(k))) continue;
    const Steps steps = StepsAround(k, seen.per_disparity);
    for (int s = 0; s < steps.count && stereo[k] < best; ++s) {
      const cv::Vec2f place = PlaceAt(seen, steps.first + static_cast<float>(s) * steps.step,
                                      views.depth_per_disparity);
      const cv::Vec2f way = place - seen.expected;
      if (way.dot(way) < kLeastWay * kLeastWay) continue;
      const int then = DifferenceInTime(now, views.then, at, place + shift, best - stereo[k]);
      if (then < best) best = std::min(best, stereo[k] + then);
    }
  }
  if (best >= enough) return log_odds;
  return std::max(static_cast<float>(best) / unit - moving, 0.0F) * gain;
}

}  // namespace aisle::slam::dynamic
