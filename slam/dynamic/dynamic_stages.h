#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "slam/camera/stereo_camera.h"
#include "slam/dynamic/common/dynamic_regions.h"
#include "slam/dynamic/paper/paper_method.h"
#include "slam/dynamic/robust/robust_method.h"

namespace aisle::slam {

/// The paper's method in one frame.
struct PaperTrace {
  dynamic::PaperOptions options;
  dynamic::PaperStages stages;
};

/// The robust method in one frame; all images of half size.
struct RobustTrace {
  dynamic::RobustStages stages;
  /// By how much the flow over the shortest gap differs from what a static world would show,
  /// half-size pixels; empty where there is no past to compare with.
  cv::Mat2f residual;
  double gap_s = 0;            ///< length of that gap
  double flow_noise = 0;       ///< as measured, half-size pixels
  cv::Mat1f probability = {};  ///< of moving, full size
};

/// What every stage of the detector found in one frame, kept on request alone, for pictures and
/// tests: nothing that is decided depends on it. Of the traces there is that of the method in use;
/// none of the paper's method in the first frame, while that of the robust one, without a past, has
/// no gaps and no residual.
struct DynamicStages {
  cv::Mat1b left;  ///< the image itself
  DynamicRegions regions = {};
  std::optional<PaperTrace> paper = {};
  std::optional<RobustTrace> robust = {};
};

/// What the step from `before` left to be seen; of a result that nothing has been moved out of yet.
RobustTrace TraceOf(const dynamic::RobustState& before, const dynamic::RobustResult& result,
                    const StereoCamera& camera);

}  // namespace aisle::slam
