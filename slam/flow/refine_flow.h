#pragma once

#include <opencv2/core.hpp>

namespace aisle::slam {

/// Makes a flow smooth but for its edges and true to both images: `iterations` fixed-point steps of
/// the energy of Brox et al., "High Accuracy Optical Flow Estimation Based on a Theory for
/// Warping", 2004, with constancy of grey values and of their gradients, each in pixels of flow.
/// The pixel x of `image` is seen at x + (u, v) of `view`. All of one size, two pixels or more a
/// side.
void RefineFlow(const cv::Mat1f& image, const cv::Mat1f& view, int iterations, cv::Mat1f& u,
                cv::Mat1f& v);

}  // namespace aisle::slam
