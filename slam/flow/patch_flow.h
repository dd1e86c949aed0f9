#pragma once

#include <opencv2/core.hpp>

#include "slam/flow/flow_pyramid.h"

namespace aisle::slam {

/// Dense flow by inverse search of patches (Kroeger et al., "Fast Optical Flow using Dense Inverse
/// Search", 2016), refined at each size: the pixel x of the image is seen at x + flow(x) of `view`,
/// which has the image's size. Zero where the images are too small to tell. On one thread.
cv::Mat2f FlowTo(const cv::Mat1b& view, const FlowPyramid& image, const DenseFlowOptions& options);

}  // namespace aisle::slam
