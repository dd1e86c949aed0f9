#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <utility>
#include <vector>

#include "harness/plugs/simulated_sequence.h"

namespace aisle {

/// What rendering a scene costs, beside the bare primary rays of the same images in the same
/// process. Medians over `frames`, milliseconds.
struct RenderCost {
  double pair_ms = 0;          ///< a stereo pair with all truth
  double bare_primary_ms = 0;  ///< primary ray packets of the same two images alone
  double ratio = 0;            ///< pair_ms / bare_primary_ms
  int frames = 0;
  std::vector<std::pair<std::string, double>> stage_ms;  ///< dearest first
};

/// Times `frames` frames spread over the scene. Throws InputError for a bad scene.
RenderCost MeasureRender(const SimulatedSequenceOptions& options, int frames);

/// One left image by the nightly light beside a path-traced one; linear, in shares of white.
struct LightComparison {
  int frame = 0;
  cv::Mat1f nightly, reference;
  double median_relative_error = 0;
  double ssim = 0;
  double mean_ratio = 0;  ///< nightly over reference
  /// Of two references of half as many paths each: what of the error is their noise.
  double noise_median_relative = 0, noise_ssim = 0;
};

/// `frame` < 0: the middle one; both images are `reduce` times smaller than the camera's. Minutes.
/// Throws InputError for a bad scene or frame.
LightComparison CompareLight(const SimulatedSequenceOptions& options, int frame, int samples,
                             int reduce);

}  // namespace aisle
