#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <optional>

#include "harness/contract/score.h"

namespace aisle {

/// How near outlines must run; one of the three at most.
struct OutlineOptions {
  std::optional<double> px;     ///< none: 3
  std::optional<double> share;  ///< instead, of the image's diagonal
  bool davis = false;  ///< instead, as DAVIS's own program: outline, nearness, mean of frames
};

/// A true mask and the one that is to be scored, of one size; 0 = static.
struct MaskPair {
  cv::Mat1b truth, mask;
};

/// The mask scores of so many frames, of which `at` gives one after the other: of pixels, outlines
/// and objects, which are blobs of moving pixels. Nothing that needs the pictures.
Scorecard ScoreMaskImages(std::size_t count, const std::function<MaskPair(std::size_t)>& at,
                          const OutlineOptions& outline = {});

}  // namespace aisle
