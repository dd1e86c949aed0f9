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

/// Takes off the log-odds of moving that a gap found what another comparison says against it: who
/// walked a second ago may stand now. `per_step` is the residual of that gap, shared out among its
/// steps, of which the other comparison spans `steps`. Against "moves still, at no less than
/// least_speed_share of that" stands "is static"; where the ratio of the two densities of the other
/// residual is for static, it is taken off, down to zero. Log-odds count up to
/// EvidenceOptions::most. What moves too slowly for the other to tell keeps all.
EndedMotion TakeOffEndedMotion(const LatestStep& step, int steps, const Texture& texture,
                               const cv::Mat2f& per_step, const cv::Mat1f& log_odds,
                               const EvidenceOptions& options);

}  // namespace aisle::slam::dynamic
