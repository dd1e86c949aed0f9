#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "slam/dynamic/paper/paper_options.h"

namespace aisle::slam::dynamic {

/// One point seen in two left images.
struct Track {
  cv::Point2f previous, current;
};

/// Where points of the previous image are in the current one, by pyramidal Lucas-Kanade; nothing
/// for those that are lost, leave the image or fail the check there and back.
std::vector<std::optional<cv::Point2f>> FollowPoints(const cv::Mat1b& previous,
                                                     const cv::Mat1b& current,
                                                     const std::vector<cv::Point2f>& points,
                                                     const FlowOptions& options);

/// The same as tracks, in the same order; lost points are left out.
std::vector<Track> TrackPoints(const cv::Mat1b& previous, const cv::Mat1b& current,
                               const std::vector<cv::Point2f>& points, const FlowOptions& options);

/// The median of how far they have gone, pixels; 0 of none.
double MedianFlow(const std::vector<Track>& tracks);

}  // namespace aisle::slam::dynamic
