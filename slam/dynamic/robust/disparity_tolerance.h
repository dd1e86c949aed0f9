#pragma once

#include <cmath>

#include "slam/dynamic/robust/robust_options.h"

namespace aisle::slam::dynamic {

/// Whether two disparities are of one surface, everywhere in the method by one rule: two sure
/// measurements of it differ by less than the tolerance, and what differs by more than twice the
/// tolerance is another surface. Between the two nobody can tell, and who asks says by the question
/// which mistake is the worse one. Built from the noise that is measured while running, so that it
/// means the same for every camera and matcher. Lengths are half-size pixels.
class DisparityTolerance {
 public:
  /// `noise`: the deviation of one disparity.
  DisparityTolerance(const ToleranceOptions& options, double noise)
      : least_(static_cast<float>(options.sigmas * noise)),
        share_(static_cast<float>(options.share)),
        noise_(static_cast<float>(noise)),
        sigmas_(static_cast<float>(options.sigmas)) {}

  /// Of a surface at this disparity.
  float At(float disparity) const { return least_ + share_ * disparity; }
  bool Same(float disparity, float other) const {
    return std::abs(disparity - other) < At(disparity);
  }
  bool IsOther(float disparity, float other) const {
    return std::abs(disparity - other) > 2 * At(disparity);
  }
  /// Whether `other` is another surface nearer to the camera.
  bool IsNearer(float disparity, float other) const {
    return other - disparity > 2 * At(disparity);
  }

  float noise() const { return noise_; }    ///< deviation of one disparity
  float sigmas() const { return sigmas_; }  ///< see ToleranceOptions

 private:
  float least_, share_, noise_, sigmas_;
};

}  // namespace aisle::slam::dynamic
