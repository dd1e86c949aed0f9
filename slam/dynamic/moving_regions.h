#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "slam/dynamic/robust_options.h"

namespace aisle::slam::dynamic {

/// A region of nodes that moves.
struct NodeRegion {
  int id = 0;
  cv::Rect box;         ///< nodes
  double log_odds = 0;  ///< of its best node
  cv::Point2f flow;     ///< pixels, from the previous frame to this one: median of its points
};

struct NodeRegions {
  cv::Mat1i labels;  ///< per node: index into regions + 1; 0 = static
  std::vector<NodeRegion> regions;
};

/// What a point says of its node.
struct PointVote {
  cv::Point node;
  double log_odds = 0;  ///< of moving
  /// Metres a frame that the rig's motion leaves unexplained, from the current rig; zero where that
  /// is not known.
  Eigen::Vector3d drift = Eigen::Vector3d::Zero();
};

/// Connected nodes above keep_log_odds that have a node above birth_log_odds among them, or overlap
/// a region of the previous frame; small ones are dropped, and so are those that points contradict:
/// dense comparison alone is deceived by repeated patterns, whose disparity may be off by a period.
/// A region takes over the id of the previous one it overlaps most (each id goes to one region),
/// else `next_id`, which is advanced. `previous` has been carried to the current frame already.
NodeRegions FindRegions(const cv::Mat1f& log_odds, const std::vector<PointVote>& votes,
                        const NodeRegions& previous, int& next_id, const RegionOptions& options);

}  // namespace aisle::slam::dynamic
