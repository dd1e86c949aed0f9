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
#include "slam/dynamic/robust/dense_frame.h"
#include "slam/dynamic/robust/ego_motion.h"
#include "slam/dynamic/robust/floor_plane.h"
#include "slam/dynamic/robust/label_memory.h"
#include "slam/dynamic/robust/robust_options.h"

namespace aisle::slam::dynamic {

/// All that the method remembers between frames. A value: copies are cheap, as images are shared
/// and never written again.
struct RobustState {
  std::int64_t stamp_ns = 0;
  std::vector<DenseFrame> frames;  ///< the latest ones, newest last, up to kLongestGap
  std::optional<Eigen::Isometry3d> T_now_before;  ///< the latest motion of the rig
  double step_s = 0;                              ///< its duration
  std::array<MeasurementNoise, kGaps.size()> noise = {MeasurementNoise(0.17, 0.17, 0.5),
                                                      MeasurementNoise(0.17, 0.17, 0.5),
                                                      MeasurementNoise(0.25, 0.25, 0.5)};
  std::array<double, kGaps.size()> flow_noise = {0.1, 0.12, 0.15};  ///< half-size pixels
  LabelMemory memory;
  std::size_t long_slot = 0;  ///< in kGaps, of the longer gap compared last; 0: none was
  int next_region_id = 0;
};

/// The way back over one gap.
struct GapMotion {
  std::size_t slot = 0;  ///< in kGaps
  int gap = 1;           ///< frames
  cv::Mat2f expected;    ///< half-size pixels of the earlier frame, were all static
  cv::Mat2f flow;        ///< the same, whatever moved
  EgoMotion motion;
  cv::Mat1f evidence;  ///< log-odds of moving per half-size pixel, of this gap, less what ended
  cv::Mat2f per_step;  ///< what the static world leaves unexplained of the flow, for each step
};

/// What the stages of one step found, for pictures and tests.
struct RobustStages {
  cv::Mat1f half_disparity;
  std::vector<GapMotion> gaps;
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
/// left in `before`, which is not changed. Stamps must rise. `predicted` is where the caller
/// expects the rig to have moved since the last frame, if it knows (T_now_before).
RobustResult StepRobust(const RobustState& before, const StereoPair& images, std::int64_t stamp_ns,
                        const std::optional<Eigen::Isometry3d>& predicted,
                        const StereoCamera& camera, const RobustOptions& options);

}  // namespace aisle::slam::dynamic
