#pragma once

#include "slam/common/option_fields.h"

namespace aisle::slam {

/// As many disparities are searched at most: what works on all of them has room for so many.
inline constexpr int kMostDisparities = 128;

/// Semi-global matching. Costs and prices are of one path: how many of a pixel's 54 census bits (a
/// quarter of nine times 24) may differ before another disparity is cheaper.
struct SemiGlobalOptions {
  /// Multiple of 32, up to kMostDisparities. Of images of half size 96 are 192 full pixels, 0.27 m
  /// with the default rig.
  int max_disparity_px = 96;
  int p1 = 10;  ///< P1: price of a change of disparity by one
  /// P2: price of any other change, halved where the grey value changes by `p2_contrast` and never
  /// less than the last.
  int p2 = 70, p2_contrast = 16, least_p2 = 30;
  int uniqueness_percent = 5;  ///< margin by which the best cost must win
  int left_right_px = 1;       ///< allowed disagreement of left-to-right and right-to-left
  int speckle_px = 40;         ///< smaller islands of disparity are dropped; pixels
  int speckle_step_px = 2;     ///< change of disparity from pixel to pixel that parts islands
};

/// Names every option with its range, unit and a sentence.
void Describe(OptionFields& fields, SemiGlobalOptions& options);

}  // namespace aisle::slam
