#include "slam/stereo/dense/cost_paths.h"

#include <algorithm>
#include <utility>

namespace aisle::slam {
namespace {

using std::uint8_t;

constexpr int kMargin = 32;  // bytes around the path costs of a pixel

struct Prices {
  uint8_t small, large;
};

/// Equation (13), without branches, so that it is vectorised. Returns the least of the path costs.
/// `before` can be read one beyond either end.
template <bool kAdd, int kDisparities>
uint8_t Step(const uint8_t* costs, const uint8_t* before, uint8_t least_before, Prices prices,
             uint8_t* now, uint8_t* sums) {
  const auto any = static_cast<uint8_t>(least_before + prices.large);
  uint8_t least = 255;
#pragma GCC ivdep
  for (int d = 0; d < kDisparities; ++d) {
    const uint8_t below = before[d - 1], above = before[d + 1], same = before[d];
    const auto stepped = static_cast<uint8_t>((below < above ? below : above) + prices.small);
    const uint8_t near = same < stepped ? same : stepped;
    const auto rest = static_cast<uint8_t>((near < any ? near : any) - least_before);
    const auto cost = static_cast<uint8_t>(costs[d] + rest);
    now[d] = cost;
    sums[d] = kAdd ? static_cast<uint8_t>(sums[d] + cost) : cost;
    least = cost < least ? cost : least;
  }
  return least;
}

}  // namespace

CostPaths::CostPaths(int paths, int disparities, const StepPrices& prices)
    : paths_(paths),
      disparities_(disparities),
      stride_(disparities + 2 * kMargin),
      prices_(prices),
      least_(static_cast<std::size_t>(paths), 0),
      before_(static_cast<std::size_t>(paths * stride_), static_cast<uint8_t>(255 - prices.small)),
      now_(before_) {
  for (int k = 0; k < paths; ++k) {  // before the first pixel nothing costs anything
    std::fill_n(before_.begin() + k * stride_ + kMargin, disparities, uint8_t{0});
  }
}

template <bool kAdd, int kDisparities>
void CostPaths::AdvanceBy(const PathPixels& pixels) {
  const uint8_t* before = before_.data() + kMargin;
  uint8_t *now = now_.data() + kMargin, *least = least_.data();
  for (int k = 0; k < paths_; ++k) {
    least[k] =
        Step<kAdd, kDisparities>(pixels.costs + k * pixels.costs_stride, before + k * stride_,
                                 least[k], {prices_.small, prices_.large[pixels.contrasts[k]]},
                                 now + k * stride_, pixels.sums + k * pixels.sums_stride);
  }
  std::swap(before_, now_);
}

template <bool kAdd>
void CostPaths::Advance(const PathPixels& pixels) {
  switch (disparities_) {
    case 32:
      return AdvanceBy<kAdd, 32>(pixels);
    case 64:
      return AdvanceBy<kAdd, 64>(pixels);
    case 96:
      return AdvanceBy<kAdd, 96>(pixels);
    default:
      return AdvanceBy<kAdd, 128>(pixels);
  }
}

template void CostPaths::Advance<false>(const PathPixels&);
template void CostPaths::Advance<true>(const PathPixels&);

}  // namespace aisle::slam
