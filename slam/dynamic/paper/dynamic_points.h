#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "slam/dynamic/paper/flow_tracks.h"
#include "slam/dynamic/paper/fundamental.h"
#include "slam/dynamic/paper/paper_options.h"

namespace aisle::slam::dynamic {

/// A tracked point of the current image under the epipolar test.
struct TestedPoint {
  cv::Point2f position;     ///< in the current left image
  float disparity = 0;      ///< pixels
  double epipolar_px = 0;   ///< D_epi, equation (2)
  double threshold_px = 0;  ///< T_epi, equation (3)
  bool IsDynamic() const { return epipolar_px > threshold_px; }
};

/// Tests every track whose current point has a known disparity nearby (5x5), equations (1) to (3);
/// tracks without one are left out, as equation (3) has no value for them.
std::vector<TestedPoint> TestAgainstEpipolarLines(const std::vector<Track>& tracks,
                                                  const FundamentalEstimate& estimate,
                                                  const cv::Mat1f& disparity,
                                                  const EpipolarOptions& options);

/// Points that belong to one moving object, and where to look for its outline.
struct PointGroup {
  std::vector<TestedPoint> points;
  cv::Rect roi;  ///< inside the image, encloses the points
};

/// Joins dynamic points that are no further apart than T_s (equation (4), of the nearer of the two)
/// and in disparity than T_disp, also through others; keeps groups of min_points or more. Points
/// that are not dynamic are ignored. Groups are ordered by their first point.
std::vector<PointGroup> GroupDynamicPoints(const std::vector<TestedPoint>& points, cv::Size image,
                                           const GroupOptions& options);

}  // namespace aisle::slam::dynamic
