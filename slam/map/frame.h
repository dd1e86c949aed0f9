#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <vector>

#include "slam/feature/feature_grid.h"
#include "slam/feature/features.h"
#include "slam/feature/patch.h"

namespace aisle::slam {

/// What a feature measures of a landmark: pixel and disparity, with their noise.
struct Measurement {
  Eigen::Vector3d uvd = Eigen::Vector3d::Zero();  ///< pixels of the full left image; d: disparity
  double sigma_px = 1;                            ///< deviation of u and of v
  double sigma_d = 0;                             ///< deviation of the disparity; 0: not measured
  /// What share of u's error the disparity has as well: 0 where it is measured by itself, 1 where
  /// it is the left column less a right one that sigma_d is the deviation of.
  double u_in_d = 0;
  /// Of the right camera alone: u is a column of the right image, which is the left one less the
  /// disparity, and there is no depth.
  bool right = false;

  bool has_depth() const { return sigma_d > 0; }
};

/// Deviation of a measured disparity by itself, whatever the pixel is.
inline double DisparitySigma(const Measurement& measurement) {
  return std::hypot(measurement.sigma_d, measurement.u_in_d * measurement.sigma_px);
}

/// The 95 % bound of chi-square for what a measurement without or with depth says, two or three
/// numbers: one that is further off, in squared deviations, is an outlier.
inline double Chi2Bound(const Measurement& measurement) {
  constexpr double kPixel = 5.991, kStereo = 7.815;
  return measurement.has_depth() ? kStereo : kPixel;
}

/// One instant as the front end leaves it. Immutable once made, and shared: a keyframe keeps it.
struct Frame {
  std::int64_t id = 0;
  std::int64_t stamp_ns = 0;
  Features features;                      ///< of the left image
  std::vector<Measurement> measurements;  ///< of features[i]
  std::vector<FeaturePatch> patches;      ///< of features[i]; or none at all
  FeatureGrid grid;                       ///< over features
  double scale = 1.2;                     ///< between pyramid levels

  int size() const { return features.size(); }
};

}  // namespace aisle::slam
