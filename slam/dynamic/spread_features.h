#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "slam/dynamic/paper_options.h"

namespace aisle::slam::dynamic {

/// A corner and how strongly it is one.
struct Corner {
  cv::Point2f position;
  float response = 0;  ///< FAST score, grey levels
};

/// FAST corners of every square region of the image, many more than needed, in raster order of the
/// regions. A region where the threshold finds nothing is searched again with the lower one.
std::vector<Corner> DetectInCells(const cv::Mat1b& image, const SpreadOptions& options);

/// Thins corners to about `count`, evenly over an image of the given size: nodes of a quadtree that
/// hold more than one corner are split in four, coarse nodes first and the fullest first among
/// equals, until `count` nodes hold a corner (at most three more, as a split adds up to three) or
/// no node can be split. Each node keeps its strongest corner.
std::vector<Corner> SpreadByQuadtree(const std::vector<Corner>& corners, cv::Size image, int count);

/// Both, as in section III-A of the paper.
std::vector<cv::Point2f> SpreadFeatures(const cv::Mat1b& image, const SpreadOptions& options);

}  // namespace aisle::slam::dynamic
