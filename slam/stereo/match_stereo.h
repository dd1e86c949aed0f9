#pragma once

#include <vector>

#include "slam/camera/stereo_camera.h"
#include "slam/feature/extract.h"
#include "slam/stereo/stereo_options.h"

namespace aisle::slam {

/// The disparity of one left feature, in full-image pixels; none where `sigma` is 0.
struct Disparity {
  float value = 0;
  float sigma = 0;  ///< standard deviation

  bool known() const { return sigma > 0; }
};

/// For each left feature its disparity, if the right image shows it: matched along the row band by
/// descriptor, then aligned to a fraction of a pixel by comparing patches at the feature's level.
/// The deviation follows from the patch's gradient along the row. Same length as left.features.
std::vector<Disparity> MatchStereo(const ImageFeatures& left, const ImageFeatures& right,
                                   const StereoCamera& camera, const StereoOptions& options);

}  // namespace aisle::slam
