#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "slam/dynamic/paper_options.h"

namespace aisle::slam::dynamic {

/// One point seen in two left images.
struct Track {
  cv::Point2f previous, current;
};

/// Follows points of the previous image into the current one by pyramidal Lucas-Kanade. Points that
/// are lost, leave the image or fail the check there and back are left out; order is kept.
std::vector<Track> TrackPoints(const cv::Mat1b& previous, const cv::Mat1b& current,
                               const std::vector<cv::Point2f>& points, const FlowOptions& options);

}  // namespace aisle::slam::dynamic
