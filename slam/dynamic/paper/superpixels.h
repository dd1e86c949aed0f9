#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "slam/dynamic/paper/paper_options.h"

namespace aisle::slam::dynamic {

/// Centre of a superpixel: mean position and grey value of its pixels.
struct ClusterCentre {
  double x = 0, y = 0, grey = 0;
  int pixels = 0;  ///< 0: the superpixel has lost all its pixels; the centre stays where it was
};

/// A segmentation of an image (or of the part of one that was given).
struct Superpixels {
  cv::Mat1i labels;                    ///< index into centres, for every pixel
  std::vector<ClusterCentre> centres;  ///< in pixels of the segmented image
  int iterations = 0;
  std::int64_t pixels_classified = 0;  ///< pixels compared with centres, summed over iterations
  std::int64_t distances = 0;          ///< evaluations of equation (5)
};

/// N_c for an image: colour_share of the range between the 5th and 95th percentile of its grey
/// values, at least one grey level.
double ColourScale(const cv::Mat1b& image, const SuperpixelOptions& options);

/// SLIC on grey values: every iteration assigns every pixel to the nearest centre by equation (5)
/// among those whose 2S x 2S window holds it, then moves the centres to the mean of their pixels.
Superpixels SegmentFully(const cv::Mat1b& image, double colour_scale,
                         const SuperpixelOptions& options);

/// The paper's SLIC: as above, but an iteration looks only at unstable pixels, at first those at
/// the edges of the initial squares. A pixel stays unstable if it changed superpixel; its four
/// neighbours become unstable if it did or if their superpixel is another one (equation (7)).
Superpixels SegmentUnstable(const cv::Mat1b& image, double colour_scale,
                            const SuperpixelOptions& options);

}  // namespace aisle::slam::dynamic
