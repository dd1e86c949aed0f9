#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace aisle::slam {

/// What a path pays for a change of disparity from pixel to pixel: `small` for a step of one,
/// `large` for any other, by how much the grey value changes there.
struct StepPrices {
  std::uint8_t small = 10;
  std::array<std::uint8_t, 256> large = {};
};

/// The next pixel of every path: numbers per disparity of path k at ... + k * stride.
struct PathPixels {
  const std::uint8_t* costs;
  std::ptrdiff_t costs_stride;
  const std::uint8_t* contrasts;  ///< of grey to the pixel before, one a path; any at first
  std::uint8_t* sums;             ///< takes the path costs
  std::ptrdiff_t sums_stride;
};

/// Paths of semi-global matching that go side by side and know nothing of each other: every row of
/// a band to the right, or every column of a strip downwards. Equation (13) of Hirschmueller,
/// "Stereo Processing by Semiglobal Matching and Mutual Information", 2008. Whole numbers below
/// 256: costs and the dearest price must sum to at most 127.
class CostPaths {
 public:
  /// 32, 64, 96 or 128 disparities.
  CostPaths(int paths, int disparities, const StepPrices& prices);

  /// Take every path one pixel further, and write its path costs or add them to what is there.
  void AdvanceAndSet(const PathPixels& pixels) { Advance<false>(pixels); }
  void AdvanceAndAdd(const PathPixels& pixels) { Advance<true>(pixels); }

 private:
  template <bool kAdd>
  void Advance(const PathPixels& pixels);
  template <bool kAdd, int kDisparities>
  void AdvanceBy(const PathPixels& pixels);

  int paths_, disparities_, stride_;
  StepPrices prices_;
  std::vector<std::uint8_t> least_;  // of each path
  // Path costs where each path was and where it is, in turn, between margins that never win.
  std::vector<std::uint8_t> before_, now_;
};

}  // namespace aisle::slam
