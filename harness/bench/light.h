#pragma once

#include <opencv2/core.hpp>

#include "harness/plugs/light_check.h"

namespace aisle {

/// How near the nightly light must come to path tracing.
struct LightBounds {
  double median_relative_error = 0.05;
  double ssim = 0.95;
};
bool Keeps(const LightComparison& light, const LightBounds& bounds = {});

/// Nightly above, reference in the middle, and below how they differ: mid grey none, white and
/// black 20 % too bright and too dark.
cv::Mat1b LightSheet(const LightComparison& light);

}  // namespace aisle
