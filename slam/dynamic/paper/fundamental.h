#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "slam/dynamic/paper/flow_tracks.h"
#include "slam/dynamic/paper/paper_options.h"

namespace aisle::slam::dynamic {

/// F with x_current^T F x_previous = 0 for a static scene, and how it came about.
struct FundamentalEstimate {
  bool found = false;  ///< false with fewer than nine tracks or without any agreement
  Eigen::Matrix3d F = Eigen::Matrix3d::Zero();  ///< rank 2, unit Frobenius norm
  std::vector<bool> is_inlier;                  ///< per track
  int inliers = 0;
  int iterations = 0;
  bool standing = false;  ///< the camera did not move: F is not determined by the static points
};

/// Distance in pixels of a track's current point from the epipolar line of its previous point,
/// equations (1) and (2). Zero where the line is undefined.
double EpipolarDistance(const Eigen::Matrix3d& F, const Track& track);

/// Distance in pixels of a track's current point from where the static scene allows it: from the
/// epipolar line, or from the previous point if the camera stands.
double DistanceFromStatic(const FundamentalEstimate& estimate, const Track& track);

/// Least-squares F of nine tracks or more: coordinates normalised, smallest right singular vector
/// of the design matrix, rank reduced to two.
Eigen::Matrix3d FundamentalFromTracks(std::span<const Track> tracks);

/// Nine-point algorithm inside RANSAC; the best hypothesis is refitted to its inliers. The samples
/// are a function of the seed and the number of the hypothesis alone.
FundamentalEstimate EstimateFundamental(const std::vector<Track>& tracks,
                                        const FundamentalOptions& options);

}  // namespace aisle::slam::dynamic
