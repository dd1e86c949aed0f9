#pragma once

#include <cmath>

namespace aisle::slam {

/// Huber's cost of a squared whitened error, and the weight that stands for it in least squares.
struct RobustCost {
  double cost = 0, weight = 1;
};

/// Huber (1964): squares up to `bound` (of the squared error), beyond it as steep as there.
inline RobustCost Huber(double chi2, double bound) {
  if (chi2 <= bound) return {chi2, 1.0};
  const double root = std::sqrt(chi2 * bound);
  return {2 * root - bound, root / chi2};
}

}  // namespace aisle::slam
