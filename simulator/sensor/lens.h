#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace aisle::sim {

/// How a lens spreads the light of a point: a sharp core and a faint veil.
struct LensOptions {
  /// Standard deviation of the core in the middle of the picture, pixels; 0: none. Diffraction,
  /// defocus and aberrations together. From 0.7 on MTF(f) = exp(-2 (π · blur_px · f)²), f in cycles
  /// a pixel up to a quarter. Up to 0.45 it is that of a pixel and its two neighbours,
  /// 1 - blur_px² (1 - cos 2πf): the same where f is small, and more above.
  float blur_px = 0.38f;
  /// What curvature of the field adds in the farthest corner, pixels, in quadrature. Defocus grows
  /// with the square of the distance from the middle, the variance with its fourth power.
  float field_blur_px = 0;
  /// Share of all light that leaves its place, scattered and reflected between lens and sensor:
  /// half of it spreads evenly over the picture, half about its place (a normal distribution of a
  /// sixteenth of the width). The veiling glare index of ISO 9358, to first order.
  float glare = 0;

  /// The first rule broken, with name, value and bound; empty if none is.
  std::string Validate() const;
};

/// The image as the lens shows it: a Gaussian core, wider towards the corners, under a veil of
/// glare. The glare neither makes light nor takes any. Same bits over any number of threads.
cv::Mat1f SpreadByLens(const cv::Mat1f& radiance, const LensOptions& lens);

/// The veil alone, without the core: (1 - share) of each pixel's light stays, `share` spreads.
cv::Mat1f AddGlare(const cv::Mat1f& radiance, float share);

}  // namespace aisle::sim
