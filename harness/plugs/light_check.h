#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "harness/plugs/simulated_sequence.h"

namespace aisle {

/// One left image by the nightly light beside a path-traced one; linear, in shares of white.
struct LightComparison {
  int frame = 0;
  cv::Mat1f nightly, reference;
  double median_relative_error = 0;
  double ssim = 0;
  double mean_ratio = 0;  ///< nightly over reference
  /// Of two references of half as many paths each: what of the error is their noise.
  double noise_median_relative = 0, noise_ssim = 0;

  /// The change to the next frame by both, rms in shares of white.
  struct Change {
    int pixels = 0;
    double rms_nightly = 0, rms_reference = 0;
    double rms_between = 0;  ///< of one change less the other
    double rms_noise = 0;    ///< what of it is the paths' own noise
    double correlation = 0;
  };
  std::optional<Change> everywhere, on_movers;  ///< if it was asked for
};

struct LightComparisonOptions {
  int frame = -1;     ///< < 0: the middle one
  int samples = 256;  ///< paths a pixel
  int reduce = 2;     ///< how many times smaller than the camera's both images are
  bool next = false;  ///< the change to the next frame too, at twice the time
};

/// Minutes. Throws InputError for a bad scene or frame.
LightComparison CompareLight(const SimulatedSequenceOptions& scene,
                             const LightComparisonOptions& options);

struct ForeignPictureOptions {
  int samples = 256;  ///< paths a pixel
  int depth = 8;      ///< surfaces a path may touch
  int threads = 0;    ///< 0: all
};

/// Path-traces a scene of another renderer (simulator/foreign tells the dialect): linear radiance,
/// B, G, R. Throws InputError "file: key: what is wrong".
cv::Mat3f TraceForeignPicture(const std::string& file, const ForeignPictureOptions& options);

}  // namespace aisle
