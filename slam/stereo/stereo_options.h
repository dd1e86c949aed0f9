#pragma once

#include "slam/common/option_fields.h"

namespace aisle::slam {

/// How a matched feature's column in the right image is told to less than a pixel.
enum class RowRefinement {
  kLeastSquares,  ///< see AlignAlongRow
  kParabola,      ///< as published of ORB-SLAM2, see AlignByParabola
};

/// How left features find their disparity.
struct StereoOptions {
  int descriptor_distance = 75;  ///< bits; no match beyond
  double row_band_px = 2.0;      ///< pixels of the right feature's level, up and down
  double nearest_m = 0;          ///< metres; 0: one baseline
  /// Pixels of the level, of the square that is compared. Where it reaches past a thing's edge,
  /// what lies behind draws the disparity down: a square of five makes paths 0.1 % longer than of
  /// three.
  int patch_radius_px = 3;
  int search_px = 5;  ///< pixels of the level, around the right feature
  RowRefinement refinement = RowRefinement::kLeastSquares;
  double worst_to_median = 2.1;  ///< matches whose patches differ more than this x median go
  /// Pixels of the level: what no patch shows of a disparity's deviation (calibration, slanted
  /// surfaces). Less makes well-textured far points decide the scale, and calibration biases it.
  double disparity_noise_px = 0.5;
  double usual_slant = 0.05;  ///< disparity per pixel: deviation over a patch's surface
  double image_noise = 3.0;   ///< grey levels: deviation of one pixel's brightness
};

/// Names every option with its range, unit and a sentence.
void Describe(OptionFields& fields, StereoOptions& options);

}  // namespace aisle::slam
