#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "slam/dynamic/robust_options.h"

namespace aisle::slam::dynamic {

/// A point seen in consecutive frames.
struct PointTrack {
  int id = 0;
  /// (u, v, disparity) in pixels of the left image, newest last, one per frame, at most
  /// kLongestGap + 1; disparity <= 0 where it is not known.
  std::vector<Eigen::Vector3d> seen;
  int age = 0;          ///< frames since it was first seen
  double log_odds = 0;  ///< of moving, carried over frames

  const Eigen::Vector3d& now() const { return seen.back(); }
  /// Where it was `gap` frames ago; null if it was not seen or had no disparity then or now.
  const Eigen::Vector3d* Before(int gap) const;
};

/// Follows the tracks from the previous left image into the current one; those lost are dropped.
/// Their newest disparity is left unknown.
std::vector<PointTrack> FollowTracks(const std::vector<PointTrack>& tracks,
                                     const cv::Mat1b& previous_left, const cv::Mat1b& left,
                                     const PointTrackOptions& options);

/// Leaves one track per square of the options' spacing, the oldest, and starts tracks of unknown
/// disparity at corners in empty squares. `next_id` is advanced.
void StartTracks(std::vector<PointTrack>& tracks, const std::vector<cv::Point2f>& corners,
                 cv::Size image, int& next_id, const PointTrackOptions& options);

/// Gives every track its newest disparity, pixels: the dense one (half-size pixels) refined on the
/// full images; 0 where the one is unknown or the other disagrees with it.
void MeasureDisparities(std::vector<PointTrack>& tracks, const cv::Mat1b& left,
                        const cv::Mat1b& right, const cv::Mat1f& half_disparity,
                        const PointTrackOptions& options);

}  // namespace aisle::slam::dynamic
