#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "slam/dynamic/robust/gap_motion.h"

namespace aisle::slam::dynamic {

/// What one gap says of the current pixels.
struct GapEvidence {
  cv::Mat1f log_odds;  ///< of moving per half-size pixel, less what has ended
  cv::Mat2f per_step;  ///< what the static world leaves unexplained of the flow, for each step
};

/// What the past says of the current pixels.
struct PastEvidence {
  std::vector<GapEvidence> gaps;  ///< of those whose motion is known, in their order
  GapEvidence longer = {};        ///< of the longer gaps together, each of them as of its last turn
  cv::Mat1f log_odds;             ///< of all gaps together; 0 where they say nothing
  cv::Mat1f ended;  ///< log-odds of moving that earlier frames said of motion that has ended
  std::array<double, kSlots> flow_noise;  ///< with what the comparisons have taught
};

/// Compares the view with the frames that the motions lead back to; the longer gaps that have not
/// their turn are heard as `memory` has kept them, less what the comparisons refute. `memory` has
/// been carried to the current frame.
PastEvidence WeighPast(const RobustState& before, const View& view,
                       const std::vector<GapFlow>& flows, const std::vector<EgoMotion>& motions,
                       const LabelMemory& memory, const StereoCamera& half,
                       const DisparityTolerance& tolerance, const RobustOptions& options);

}  // namespace aisle::slam::dynamic
