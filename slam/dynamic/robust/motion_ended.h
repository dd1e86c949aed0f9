#pragma once

#include <opencv2/core.hpp>

#include "slam/dynamic/robust/dense_frame.h"
#include "slam/dynamic/robust/robust_options.h"

namespace aisle::slam::dynamic {

/// What one comparison left unexplained, per half-size pixel.
struct LatestStep {
  cv::Mat2f residual;  ///< half-size pixels, of the flow, beside the static world's
  cv::Mat1f variance;  ///< of a static pixel's residual, beyond what texture leaves open
};

/// What is left of a gap's log-odds of moving, and what has been taken off.
struct EndedMotion {
  cv::Mat1f log_odds, taken;
};

/// Takes off the log-odds of moving L that a gap found, what another comparison says against it:
/// whoever walked a second ago may stand now. With r the residual of that other comparison, which
/// spans `steps` steps, m = `steps` * `per_step` what the gap's own residual makes expected of it
/// (both half-size pixels), s = EvidenceOptions::least_speed_share, and S the information of the
/// texture under a mover's noise, the log-likelihood ratio for "is static" over "still moves, by
/// s m" is
///
///   l = log N(r; 0, 1/S) - log N(r; s m, 1/S) = s (s m'S m / 2 - m'S r).
///
/// Where L > 0, `taken` is l between 0 and EvidenceOptions::most, and max(0, min(L, most) - taken)
/// is left; elsewhere L stays. What moves too slowly for the other comparison to tell has l near 0
/// and keeps all.
EndedMotion TakeOffEndedMotion(const LatestStep& step, int steps, const Texture& texture,
                               const cv::Mat2f& per_step, const cv::Mat1f& log_odds,
                               const EvidenceOptions& options);

}  // namespace aisle::slam::dynamic
