#include "slam/stereo/dense/choose_disparity.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <vector>

namespace aisle::slam {
namespace {

using std::uint16_t;
using std::uint8_t;

constexpr int kDisparityBits = 7;

/// Fills in the costs. Returns the least with its disparity in one number: of equals the first.
template <int kDisparities>
uint16_t LeastKey(const uint8_t* some, const uint8_t* others, uint16_t* costs) {
  uint16_t least = std::numeric_limits<uint16_t>::max();
#pragma GCC ivdep
  for (uint16_t d = 0; d < kDisparities; ++d) {
    const auto cost = static_cast<uint16_t>(some[d] + others[d]);
    costs[d] = cost;
    const auto key = static_cast<uint16_t>(static_cast<uint16_t>(cost << kDisparityBits) + d);
    least = key < least ? key : least;
  }
  return least;
}

/// How many costs, times `share`, are below a limit; all of that fits.
template <int kDisparities>
int CountBelow(const uint16_t* costs, uint16_t share, uint16_t limit) {
  uint16_t below = 0;
  for (int d = 0; d < kDisparities; ++d) {
    const auto times = static_cast<uint16_t>(costs[d] * share);
    below = static_cast<uint16_t>(below + (times < limit ? 1 : 0));
  }
  return below;
}

/// Offset from `disparity` in sixteenths, -8 to 8.
int Between(const uint16_t* costs, int disparity) {
  const int before = costs[disparity - 1], here = costs[disparity], after = costs[disparity + 1];
  return (before - after) * 8 / std::max(std::max(before, after) - here, 1);
}

/// Whether no other disparity than the best and its neighbours costs less than the best one's share
/// allows. `costs` can be read one beyond either end.
template <int kDisparities>
bool IsUnique(const uint16_t* costs, int best, int uniqueness_percent) {
  const auto share = static_cast<uint16_t>(100 - uniqueness_percent);
  const auto limit = static_cast<uint16_t>(costs[best] * 100);
  int near = 0;
  for (int d = best - 1; d <= best + 1; ++d) near += costs[d] * share < limit ? 1 : 0;
  return CountBelow<kDisparities>(costs, share, limit) == near;
}

template <int kDisparities>
void Choose(const uint8_t* some, const uint8_t* others, int pixels, int uniqueness_percent,
            Winner* winners) {
  std::array<uint16_t, kDisparities + 2> padded;
  padded.fill(std::numeric_limits<uint16_t>::max());
  uint16_t* costs = padded.data() + 1;
  for (int k = 0; k < pixels; ++k, some += kDisparities, others += kDisparities) {
    const uint16_t key = LeastKey<kDisparities>(some, others, costs);
    const int best = key & ((1 << kDisparityBits) - 1);
    const bool inside = best > 0 && best + 1 < kDisparities;
    const int between = inside ? Between(costs, best) : 0;
    winners[k].cost = static_cast<uint16_t>(key >> kDisparityBits);
    winners[k].disparity = static_cast<uint8_t>(best);
    winners[k].sixteenths = static_cast<std::int16_t>(
        IsUnique<kDisparities>(costs, best, uniqueness_percent) ? 16 * best + between : -1);
  }
}

}  // namespace

void ChooseDisparities(const uint8_t* some, const uint8_t* others, int pixels, int disparities,
                       int uniqueness_percent, Winner* winners) {
  switch (disparities) {
    case 32:
      return Choose<32>(some, others, pixels, uniqueness_percent, winners);
    case 64:
      return Choose<64>(some, others, pixels, uniqueness_percent, winners);
    case 96:
      return Choose<96>(some, others, pixels, uniqueness_percent, winners);
    default:
      return Choose<128>(some, others, pixels, uniqueness_percent, winners);
  }
}

void CheckRightToLeft(const Winner* winners, int columns, int most_difference, std::int16_t unknown,
                      std::int16_t* sixteenths) {
  constexpr int kNone = -1;
  std::vector<int> chosen(static_cast<std::size_t>(columns), kNone);
  std::vector<int> least(static_cast<std::size_t>(columns), std::numeric_limits<int>::max());
  for (int x = 0; x < columns; ++x) {
    const int there = x - winners[x].disparity;
    if (winners[x].sixteenths < 0 || there < 0) continue;
    const auto at = static_cast<std::size_t>(there);
    if (winners[x].cost >= least[at]) continue;
    least[at] = winners[x].cost;
    chosen[at] = winners[x].disparity;
  }
  const auto contradicts = [&](int x, int disparity) {
    if (x < disparity) return false;
    const int other = chosen[static_cast<std::size_t>(x - disparity)];
    return other != kNone && std::abs(other - disparity) > most_difference;
  };
  for (int x = 0; x < columns; ++x) {
    const int found = winners[x].sixteenths;
    // Between two whole disparities one of them is enough.
    const bool known = found >= 0 && found <= 16 * x &&
                       !(contradicts(x, found / 16) && contradicts(x, (found + 15) / 16));
    sixteenths[x] = known ? winners[x].sixteenths : unknown;
  }
}

}  // namespace aisle::slam
