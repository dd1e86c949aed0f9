#pragma once

#include <algorithm>
#include <limits>

namespace aisle::slam::dynamic {

/// What a window's texture says of its displacement: the inverse of its covariance, symmetric, of
/// no negative eigenvalue, 1 / squared pixels. Along a straight edge it is singular, without
/// texture zero.
struct Information {
  float xx, xy, yy;
};

/// det G. What rounding leaves of a singular one counts as none: variances of 1e4 and more are
/// squared and multiplied with it, and would make much of it, of either sign.
inline float Determinant(const Information& G) {
  constexpr float kAboveRounding = 1 - 4 * std::numeric_limits<float>::epsilon();
  return std::max(kAboveRounding * (G.xx * G.yy) - G.xy * G.xy, 0.0F);
}

/// The information that is left of G where the displacement errs by `variance` besides, squared
/// pixels in each direction: (G^-1 + v I)^-1 = (G + v det(G) I) / det(I + v G), here without its
/// divisor. G need not have an inverse, and nothing is taken from anything: that is exact to
/// rounding, however large the variance.
struct Weakened {
  float added;        ///< to xx and to yy of G
  float determinant;  ///< det(I + v G), at least 1
};
inline Weakened Weaken(const Information& G, float determinant, float variance) {
  const float added = variance * determinant;
  return {added, 1 + variance * (G.xx + G.yy + added)};
}

}  // namespace aisle::slam::dynamic
