#pragma once

#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "slam/dynamic/paper/boundary_labels.h"
#include "slam/dynamic/paper/dynamic_points.h"
#include "slam/dynamic/paper/paper_options.h"

namespace aisle::slam::dynamic {

/// Where the rays of a point stopped: the last pixel before each occlusion boundary, in the order
/// +x, -x, +y, -y; rays that reached the edge of the segmentation found nothing.
std::vector<cv::Point> SearchOcclusions(const cv::Point& from, const cv::Mat1i& labels,
                                        const std::map<BoundaryKey, BoundaryType>& boundaries);

/// Smallest upright rectangle around the boundary points that the rays of a group's points find,
/// in the coordinates of the segmentation; nothing where no point is surrounded. `points` are given
/// in the same coordinates; those outside are ignored.
std::optional<cv::Rect> MarkRegion(const std::vector<cv::Point>& points, const cv::Mat1i& labels,
                                   const std::map<BoundaryKey, BoundaryType>& boundaries,
                                   const MarkOptions& options);

}  // namespace aisle::slam::dynamic
