#pragma once

#include "slam/common/option_fields.h"

namespace aisle::slam {

/// How features are found in one image.
struct FeatureOptions {
  int features = 1200;         ///< per image, over all levels; a budget, spent where corners are
  int levels = 8;              ///< of the pyramid; fewer where an image is too small for them
  double scale = 1.2;          ///< between levels
  int fast_threshold = 20;     ///< grey levels; FAST-9 contrast asked for at first
  int fast_threshold_low = 7;  ///< grey levels; asked for in cells where the first finds nothing
  /// Of the weakest to the strongest change of grey around a corner in any direction, squared: with
  /// less it is a straight edge, on which the corner slides. 0: all are taken.
  double least_corner_ratio = 0.03;
  int cell_px = 30;           ///< side of those cells, pixels of the level
  int border_px = 16;         ///< pixels of the level; no corner nearer to the image's edge
  double mask_margin_px = 3;  ///< pixels of the level; no corner nearer to a masked pixel
};

/// Names every option with its range, unit and a sentence.
void Describe(OptionFields& fields, FeatureOptions& options);

}  // namespace aisle::slam
