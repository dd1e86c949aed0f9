#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "slam/dynamic/robust/gap_motion.h"
#include "slam/dynamic/robust/step.h"

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

/// Compares the view with the frames that the motions lead back to (CompareMotion), each over its
/// own gap. The longer gaps take turns: those of other turns count as `memory` has kept them, less
/// what the comparisons refute (TakeOffEndedMotion). What the gaps say is put together by
/// CombineGaps. `motions` are those of the first flows; `memory` has been carried to the current
/// frame.
PastEvidence WeighPast(const Step& step, const std::vector<GapFlow>& flows,
                       const std::vector<EgoMotion>& motions, const LabelMemory& memory);

}  // namespace aisle::slam::dynamic
