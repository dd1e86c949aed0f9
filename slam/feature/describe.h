#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "slam/feature/descriptor.h"

namespace aisle::slam {

/// Direction from a pixel to the brightness centroid of the disc of radius 15 around it, degrees
/// [0, 360), x towards y (Rosin 1999). The pixel must be at least 15 from the image's edge.
float OrientationDeg(const cv::Mat1b& level, cv::Point pixel);

/// A pixel of a level and the direction its descriptor is turned to.
struct OrientedPixel {
  cv::Point pixel;
  float angle_deg = 0;
};

/// Rotated BRIEF (Rublee et al. 2011) of each pixel, after a blur of sigma 2 against noise.
std::vector<Descriptor> DescribePixels(const cv::Mat1b& level,
                                       const std::vector<OrientedPixel>& pixels);

}  // namespace aisle::slam
