#pragma once

#include <Eigen/Core>
#include <optional>

#include "slam/feature/patch.h"
#include "slam/map/map_options.h"

namespace aisle::slam {

/// A square of more leaves the patch as soon as it is shifted.
inline constexpr int kLargestPatchRadius = FeaturePatch::kReach - 1;

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
