#pragma once

#include <map>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "slam/dynamic/paper/disparity_planes.h"
#include "slam/dynamic/paper/paper_options.h"

namespace aisle::slam::dynamic {

/// What the boundary between superpixels i < j is.
enum class BoundaryType {
  kCoplanar,        ///< one surface
  kHinge,           ///< two surfaces that meet
  kLeftOcclusion,   ///< i lies before j
  kRightOcclusion,  ///< j lies before i
  kUnknown,         ///< one of the two has no disparity plane
};

/// The superpixels of a boundary, the smaller index first.
using BoundaryKey = std::pair<int, int>;

/// Counts and moments of a set of pixels: enough to sum a plane, or its square, over the set.
struct PixelMoments {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;

  void Add(double px, double py);
  PixelMoments operator+(const PixelMoments& other) const;
  double SumOf(const DisparityPlane& plane) const;
  double SumOfSquares(const DisparityPlane& plane) const;
};

/// E of every hypothesis of one boundary, equations (9) to (11), squared pixels of disparity.
struct BoundaryEnergy {
  double coplanar = 0, hinge = 0, left_occlusion = 0, right_occlusion = 0;

  /// The hypothesis with the least energy; of equals the simplest.
  BoundaryType Least() const;
};

/// Energies of the boundary of superpixels i and j with these planes. `boundary` are the pixels of
/// either that touch the other (B_ij), `both` all pixels of the two (U_ij).
BoundaryEnergy EnergyOf(const DisparityPlane& plane_i, const DisparityPlane& plane_j,
                        const PixelMoments& boundary, const PixelMoments& both,
                        const BoundaryOptions& options);

/// The type of every boundary of a segmentation.
std::map<BoundaryKey, BoundaryType> LabelBoundaries(const cv::Mat1i& labels,
                                                    const std::vector<DisparityPlane>& planes,
                                                    const BoundaryOptions& options);

/// Whether crossing from superpixel a to b crosses an occlusion.
bool IsOcclusion(const std::map<BoundaryKey, BoundaryType>& boundaries, int a, int b);

}  // namespace aisle::slam::dynamic
