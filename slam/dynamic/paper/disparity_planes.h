#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "slam/dynamic/paper/paper_options.h"
#include "slam/dynamic/paper/superpixels.h"

namespace aisle::slam::dynamic {

/// Equation (8): d(x, y) = a x + b y + c, in pixels of the segmented image.
struct DisparityPlane {
  double a = 0, b = 0, c = 0;
  int inliers = 0;
  int samples = 0;  ///< pixels with known disparity it was fitted to
  bool valid = false;

  double At(double x, double y) const { return a * x + b * y + c; }
};

/// A pixel and its disparity.
struct DisparitySample {
  double x = 0, y = 0, d = 0;
};

/// Plane by three-point RANSAC, refitted to the inliers by least squares. Not valid with fewer than
/// min_pixels samples or when all of them lie on a line. `stream` makes the draws of this plane its
/// own.
DisparityPlane FitDisparityPlane(const std::vector<DisparitySample>& samples, std::uint64_t stream,
                                 const PlaneOptions& options);

/// A plane for every superpixel. `disparity` covers the same pixels as the segmentation.
std::vector<DisparityPlane> FitDisparityPlanes(const Superpixels& superpixels,
                                               const cv::Mat1f& disparity,
                                               const PlaneOptions& options);

}  // namespace aisle::slam::dynamic
