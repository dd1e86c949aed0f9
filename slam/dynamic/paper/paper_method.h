#pragma once

#include <Eigen/Core>
#include <map>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "slam/dynamic/common/dynamic_regions.h"
#include "slam/dynamic/common/stereo_pair.h"
#include "slam/dynamic/paper/boundary_labels.h"
#include "slam/dynamic/paper/dynamic_points.h"
#include "slam/dynamic/paper/fundamental.h"
#include "slam/dynamic/paper/paper_options.h"
#include "slam/dynamic/paper/superpixels.h"

namespace aisle::slam::dynamic {

/// One region of interest with all that was found in it.
struct SegmentedRoi {
  cv::Rect roi;                        ///< in the left image
  Superpixels superpixels;             ///< in pixels of the roi
  std::vector<DisparityPlane> planes;  ///< per superpixel
  std::map<BoundaryKey, BoundaryType> boundaries;
};

/// What every stage found, for pictures and tests. Nothing later depends on it.
struct PaperStages {
  cv::Mat1f disparity;                ///< of the current left image, kNoDisparity where unknown
  std::vector<cv::Point2f> features;  ///< of the previous left image
  std::vector<Track> tracks;
  FundamentalEstimate fundamental;
  std::vector<TestedPoint> points;
  std::vector<PointGroup> groups;
  std::vector<SegmentedRoi> rois;          ///< one per group
  std::map<std::string, double> stage_ms;  ///< wall time; reported, never decided upon
};

struct PaperResult {
  DynamicRegions dynamic;
  cv::Mat1f disparity;  ///< of the current left image, kNoDisparity where unknown
  PaperStages stages;
};

/// The paper's method, sections III-A and III-B: moving regions of the current left image as the
/// union of rectangles. A pure function: two consecutive pairs in, no memory. Without enough
/// texture for a fundamental matrix nothing is dynamic. Region ids are the indices of the groups.
PaperResult DetectDynamicRegions(const StereoPair& previous, const StereoPair& current,
                                 const PaperOptions& options);

}  // namespace aisle::slam::dynamic
