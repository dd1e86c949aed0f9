#pragma once

#include <opencv2/core.hpp>

#include "slam/dynamic/common/stereo_pair.h"
#include "slam/dynamic/paper/paper_options.h"

namespace aisle::slam::dynamic {

/// Disparity of every left pixel in pixels (x_left - x_right >= 0), kNoDisparity where unknown.
/// Same size as the images, which must be equal in size. The columns that plain SGBM leaves empty
/// at the left edge are matched as far as the right image reaches. By half-size images, where the
/// options say so, disparities are multiples of an eighth and each is that of 2x2 pixels.
cv::Mat1f ComputeDisparity(const cv::Mat1b& left, const cv::Mat1b& right,
                           const DisparityOptions& options);

/// Median of the known disparities within `radius` pixels of a point; kNoDisparity if none is known
/// or the point lies outside.
float DisparityNear(const cv::Mat1f& disparity, const cv::Point2f& point, int radius);

}  // namespace aisle::slam::dynamic
