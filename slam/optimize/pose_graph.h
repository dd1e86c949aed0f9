#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "slam/optimize/bundle.h"

namespace aisle::slam {

/// Poses and what is known of one as seen from another.
struct PoseGraph {
  struct Edge {
    int from = 0, to = 0;  ///< indices of poses
    /// T_rig_world(from) T_world_rig(to): where `to` stands, seen from `from`.
    Eigen::Isometry3d T_from_to = Eigen::Isometry3d::Identity();
    double sigma_m = 1;         ///< deviation of the translation
    double sigma_rad = 1;       ///< deviation of the rotation
    bool may_be_wrong = false;  ///< robustified (a loop), or trusted (neighbours)
  };
  std::vector<BundleProblem::Pose> poses;
  std::vector<Edge> edges;
};

/// Spreads what edges disagree by over the free poses (Lu and Milios 1997). One thread, same bits.
BundleSummary Solve(PoseGraph& graph, int iterations);

}  // namespace aisle::slam
