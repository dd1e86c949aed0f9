#pragma once

#include <string>

#include "harness/score/mask_images.h"

namespace aisle {

/// Scores a folder of masks against a folder of true ones: PNGs, black = static, anything else =
/// moves, paired by file name; a true mask without a partner counts as an empty answer. Throws
/// InputError for folders without images, sizes that differ, masks that belong to no true one.
Scorecard ScoreMaskFolders(const std::string& truth_folder, const std::string& mask_folder,
                           const OutlineOptions& outline = {});

}  // namespace aisle
