#pragma once

#include <optional>
#include <string>

#include "harness/contract/score.h"

namespace aisle {

/// How near outlines must run.
struct OutlineOptions {
  std::optional<double> px;     ///< none: 3
  std::optional<double> share;  ///< instead, of the image's diagonal
  bool davis = false;  ///< instead, as DAVIS's own program: outline, nearness, mean of frames
};

/// Scores a folder of masks against a folder of true ones: PNGs, black = static, anything else =
/// moves, paired by file name; a true mask without a partner counts as an empty answer. Throws
/// InputError for folders without images, sizes that differ, masks that belong to no true one.
Scorecard ScoreMaskFolders(const std::string& truth_folder, const std::string& mask_folder,
                           const OutlineOptions& outline = {});

}  // namespace aisle
