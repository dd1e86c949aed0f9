#pragma once

#include <Eigen/Geometry>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "slam/camera/stereo_camera.h"
#include "slam/dynamic/common/dynamic_regions.h"
#include "slam/dynamic/common/stereo_pair.h"
#include "slam/dynamic/robust/floor_plane.h"
#include "slam/dynamic/robust/gap_flow.h"
#include "slam/dynamic/robust/past_evidence.h"
#include "slam/dynamic/robust/robust_options.h"
#include "slam/dynamic/robust/robust_state.h"

namespace aisle::slam::dynamic {

/// One gap whose motion was found.
struct GapTrace {
  GapFlow way;
  EgoMotion motion;
  GapEvidence evidence;
};

/// What the stages of one step found, for pictures and tests.
struct RobustStages {
  cv::Mat1f half_disparity;
  std::vector<GapTrace> gaps;
  std::optional<FloorPlane> floor;
  cv::Mat1b floor_mask;  ///< half size
  cv::Mat1f evidence;    ///< per half-size pixel, of this frame alone
  cv::Mat1f memory;      ///< the same with what was known before
  cv::Mat1f log_odds;    ///< the field's answer
  std::map<std::string, double> stage_ms;
};

struct RobustResult {
  RobustState state;  ///< for the next step
  DynamicRegions dynamic;
  cv::Mat1f probability;  ///< of moving, per pixel of the left image
  /// Of the rig since the newest frame kept in the state before; nothing if it was not found, or
  /// the frame shows nothing new.
  std::optional<EgoMotion> motion;
  cv::Mat1f half_disparity;  ///< of the left image, half-size pixels; kNoDisparity where unknown
  RobustStages stages;
};

/// One frame of the robust method: moving regions of the left image from what the previous frames
/// left in `before`, which is not changed. Both images have the camera's size, and stamps rise:
/// `stamp_ns` is later than the newest frame kept (asserted). `known` is how the rig has moved
/// since the last frame, kept or not, as the caller expects or has measured it, if he knows. A past
/// that a pause has made too old, of frames that showed nothing or of none at all, is forgotten:
/// nothing is found then, as in the first frame.
RobustResult StepRobust(const RobustState& before, const StereoPair& images, std::int64_t stamp_ns,
                        const KnownMotion& known, const StereoCamera& camera,
                        const RobustOptions& options);

}  // namespace aisle::slam::dynamic
