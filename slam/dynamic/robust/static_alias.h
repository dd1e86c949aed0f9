#pragma once

#include <opencv2/core.hpp>

#include "slam/dynamic/robust/dense_frame.h"
#include "slam/dynamic/robust/disparity_tolerance.h"

namespace aisle::slam::dynamic {

/// What the pixels of a frame are compared with.
struct AliasViews {
  const DenseFrame& now;
  const cv::Mat1b& then;      ///< the earlier image
  const cv::Mat1f& variance;  ///< of the difference of two grey values, per pixel of the frame
  DisparityTolerance tolerance;
  int disparities;  ///< asked for, up to kMostDisparities
  /// How much farther a static point was, in units of its depth now, for each pixel of disparity:
  /// the rig's way along the axis since the earlier frame, over focal length times baseline.
  float depth_per_disparity = 0;
};

/// A pixel that seems to have moved; half-size pixels.
struct SeenMotion {
  cv::Point at;
  float disparity = 0;           ///< that the matcher found
  cv::Vec2f flow;                ///< where it is in the earlier image
  cv::Vec2f expected;            ///< where it would be there, were it static
  float expected_disparity = 0;  ///< and its disparity there
  cv::Vec2f per_disparity;       ///< by how much `expected` moves for each pixel of disparity
};

/// Log-odds of what fits so well against what fits otherwise, for each unit of their difference.
/// Fits are mean squared differences in units of variance.
float GainPerDifference(float difference, const EvidenceOptions& options);

/// What is left of the log-odds of having moved when the best static explanation has been heard. On
/// a corrugated wall or a row of equal bars the matcher may be whole periods off, and the flow as
/// well; then neither can be taken at its word. But something static with another disparity fits
/// the right and the earlier image together as well as what moves does. All disparities that the
/// matcher searched are heard that are surely other than the pixel's own and fit the right image
/// better than their neighbours, or as well as the pixel's own does: along a beam all do. Without a
/// way that they could move the pixel by (a rig that stands still) nothing is taken off.
float LimitByAlias(const AliasViews& views, const SeenMotion& seen, float log_odds,
                   const EvidenceOptions& options);

}  // namespace aisle::slam::dynamic
