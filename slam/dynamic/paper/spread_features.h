#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "slam/dynamic/paper/paper_options.h"

namespace aisle::slam::dynamic {

/// Feature points spread over the image as in section III-A of the paper: FAST corners, more than
/// enough, of every square region (with a lower threshold where the first finds none), thinned by a
/// quadtree until N nodes hold one; each node keeps its strongest. Pixels of the image.
std::vector<cv::Point2f> SpreadFeatures(const cv::Mat1b& image, const SpreadOptions& options);

}  // namespace aisle::slam::dynamic
