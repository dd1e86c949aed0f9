#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "harness/contract/estimate.h"
#include "harness/contract/frame.h"

namespace aisle {

/// The left image with truth over it: what moves now tinted red, boxes with class and speed around
/// what may move; with an estimate also the outline of what was rejected (cyan) and the
/// keypoints (green used, grey unused, yellow on a mover). The caption stands in a bar below.
cv::Mat3b DrawOverlay(const cv::Mat1b& left, const FrameTruth* truth, const FrameEstimate* estimate,
                      const std::string& caption);

}  // namespace aisle
