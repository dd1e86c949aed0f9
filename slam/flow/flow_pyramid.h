#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "slam/flow/dense_flow_options.h"

namespace aisle::slam {

inline constexpr int kFlowPatch = 8;  ///< side of the patches that are searched for; pixels

/// What a patch says of how well its shift can be told.
struct FlowPatch {
  int x = 0, y = 0;              ///< its first pixel
  float sum_x = 0, sum_y = 0;    ///< of its gradients
  float xx = 0, xy = 0, yy = 0;  ///< inverse of their structure tensor, without means
};

/// An image at one size.
struct FlowLevel {
  cv::Mat1f image;
  cv::Mat1f gradient_x, gradient_y;  ///< grey levels per pixel
  std::vector<FlowPatch> patches;    ///< every four pixels and along the far edges
};

/// An image at each size at which flow is looked for, the finest first, each half the one before.
/// Empty if the image does not hold a few patches.
using FlowPyramid = std::vector<FlowLevel>;
FlowPyramid MakeFlowPyramid(const cv::Mat1b& image, const DenseFlowOptions& options);

/// The images of such a pyramid alone.
std::vector<cv::Mat1f> HalvedAgainAndAgain(const cv::Mat1b& image, const DenseFlowOptions& options);

}  // namespace aisle::slam
