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
  RobustStages stages;
};

/// One frame of the robust method: moving regions of the left image from what the previous frames
/// left in `before`, which is not changed. Stamps must rise. `known` is where the caller
/// expects the rig to have moved since the last frame, if it knows (T_now_before).
RobustResult StepRobust(const RobustState& before, const StereoPair& images, std::int64_t stamp_ns,
                        const KnownMotion& known, const StereoCamera& camera,
                        const RobustOptions& options);

}  // namespace aisle::slam::dynamic
