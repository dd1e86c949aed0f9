#pragma once

#include <Eigen/Core>
#include <optional>

#include "slam/common/option_fields.h"
#include "slam/feature/patch.h"

namespace aisle::slam {

/// A square of more leaves the patch as soon as it is shifted.
inline constexpr int kLargestPatchRadius = FeaturePatch::kReach - 1;

/// How a landmark is found to a fraction of a pixel: FAST's corners lie on whole pixels and jump
/// from frame to frame, what surrounds them does not.
struct PatchOptions {
  int radius_px = 4;    ///< of the square compared, pixels of the level; 0: corners stay as found
  int iterations = 10;  ///< at most; not settled by then: not aligned
  double most_shift_px = 2;        ///< pixels of the level, from the corner
  double most_scale = 1.25;        ///< of one patch's pixels in the other's, either way
  double least_correlation = 0.8;  ///< normalised; below: not the same thing
  double image_noise = 3;          ///< grey levels: deviation of one pixel's brightness
  /// Of the corner's deviation: what remains once its patch is aligned, however good the texture.
  double noise_share = 0.5;
};

/// Names every option with its range, unit and a sentence.
void Describe(OptionFields& fields, PatchOptions& options);

/// Where a point of an earlier patch is now.
struct AlignedPoint {
  Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();  ///< from the corner; pixels of its level
  double sigma_px = 0;  ///< of either coordinate, by the images' noise and texture alone
};

/// Finds the point `before_px` of patch `before` in patch `now`, by the square around it as
/// `J_before_now` (pixels of `before` per pixel of `now`) warps it: least squares over the shift, a
/// change of brightness and one of contrast free (Lucas and Kanade 1981, in the inverse form of
/// Baker and Matthews 2004). Nothing where the texture does not fix both coordinates, the square
/// leaves a patch, or the two do not show the same.
std::optional<AlignedPoint> AlignPatch(const FeaturePatch& before, const Eigen::Vector2d& before_px,
                                       const Eigen::Matrix2d& J_before_now, const FeaturePatch& now,
                                       const PatchOptions& options);

}  // namespace aisle::slam
