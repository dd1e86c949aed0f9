#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "slam/dynamic/robust/robust_state.h"
#include "slam/dynamic/robust/view.h"

namespace aisle::slam::dynamic {

/// Where the current pixels were, over one gap.
struct GapFlow {
  std::size_t slot = 0;  ///< of the gap
  int gap = 1;           ///< frames
  StaticField expected;  ///< were all static, by the expected motion
  cv::Mat2f flow;        ///< half-size pixels of the earlier frame, whatever moved
};

/// The flow over the gaps that are compared in this frame: of those that the past reaches back to
/// the shortest, and of the longer ones each in its turn, since what they say changes little from
/// frame to frame. The shortest first; none without a past. `T_now_before` is the expected motion.
std::vector<GapFlow> FollowGaps(const RobustState& before, const View& view,
                                const Eigen::Isometry3d& T_now_before, const StereoCamera& half,
                                const DenseFlowOptions& options);

}  // namespace aisle::slam::dynamic
