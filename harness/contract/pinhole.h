#pragma once

#include <cmath>

namespace aisle {

/// No camera has a shorter focal length, nor a number of pixels beyond: what does is a slip, and
/// arithmetic on it ends in infinity.
inline constexpr double kLeastFocal_px = 0.1, kFarthest_px = 1e6;

/// Whether focal lengths and principal point, in pixels, may be those of a camera.
inline bool IsPinhole(double fx, double fy, double cx, double cy) {
  const auto is_focal = [](double f) { return f >= kLeastFocal_px && f <= kFarthest_px; };
  const auto is_near = [](double c) { return std::abs(c) <= kFarthest_px; };
  return is_focal(fx) && is_focal(fy) && is_near(cx) && is_near(cy);
}

}  // namespace aisle
