#pragma once

#include <opencv2/core.hpp>

namespace aisle {

/// What the outline of a mask is, and how near is near.
struct BoundaryRule {
  double tolerance_px = 3;
  /// As the DAVIS benchmark's own program has it: a pixel that differs from its right, lower or
  /// lower right neighbour, on either side of the border; else the mask's own pixels along it.
  bool davis_outline = false;
};

/// DAVIS's rule for images of a size: near is 0.008 of their diagonal, rounded up.
BoundaryRule DavisRule(cv::Size size);

/// How well two masks' outlines agree: a pixel of one outline counts where the other's runs within
/// the tolerance (Martin, Fowlkes and Malik, PAMI 2004, without their one-to-one matching; as in
/// the DAVIS benchmark). The outline of a mask is its pixels with a 4-neighbour outside it; the
/// image's own border is no outline.
struct BoundaryCounts {
  std::int64_t truth = 0, truth_met = 0;        ///< outline pixels of truth, near the other's
  std::int64_t rejected = 0, rejected_met = 0;  ///< and the other way round
  BoundaryCounts& operator+=(const BoundaryCounts& other);
};

/// Masks of one size, 255 = set. Throws std::invalid_argument on different sizes.
BoundaryCounts CompareBoundaries(const cv::Mat1b& truth, const cv::Mat1b& rejected,
                                 const BoundaryRule& rule = {});

/// Harmonic mean of both shares; absent where neither mask has an outline.
std::optional<double> BoundaryF(const BoundaryCounts& counts);

}  // namespace aisle
