#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "slam/camera/measured_motion.h"
#include "slam/camera/stereo_camera.h"
#include "slam/dynamic/common/dynamic_regions.h"
#include "slam/dynamic/dynamic_options.h"

namespace aisle::slam {

/// A rectified stereo pair and when it was taken.
struct DynamicInput {
  std::int64_t stamp_ns = 0;
  cv::Mat1b left, right;  ///< 8-bit grey; not written to, and free again once Detect returns
  /// Where the caller expects the rig to have moved since the last frame, and how sure that is.
  std::optional<MeasuredMotion> expected = {};
  /// How it has been measured to move, by other means than what these images show against the last.
  std::optional<MeasuredMotion> measured = {};
};

struct DynamicStages;

struct DynamicOutput {
  DynamicRegions regions;  ///< of the left image; an empty mask rejects nothing
  cv::Mat1b mask_right;    ///< the same surfaces in the right image; empty like the left one
  cv::Mat1f probability;   ///< of moving, per left pixel; empty where the method knows none
  /// How the rig has moved since the last frame, by what nobody has seen move; as it was expected
  /// to where the images show too little or nothing that a vehicle can do. Nothing where the method
  /// does not ask or has not found it, or where the frame shows nothing new.
  std::optional<MeasuredMotion> rig_motion = {};
  std::map<std::string, double> stage_ms;  ///< wall time by stage; reported, never decided upon
  std::shared_ptr<const DynamicStages> stages;  ///< null unless DynamicOptions::keep_stages
};

/// Either method behind one face. Frames of one sequence, in order: stamps rise, and both images
/// have the camera's size (asserted where the method depends on it). The first frame, having no
/// past, shows nothing that moves; nor does the first after a long pause. Same images, same
/// options: the same bits, for any number of threads.
class DynamicDetector {
 public:
  DynamicDetector(const StereoCamera& camera, const DynamicOptions& options);
  DynamicDetector(DynamicDetector&&) noexcept;
  DynamicDetector& operator=(DynamicDetector&&) noexcept;
  ~DynamicDetector();

  DynamicOutput Detect(const DynamicInput& input);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Where the right camera sees what a mask rejects in the left: every masked pixel shifted by its
/// disparity (pixels; negative = unknown), small gaps between shifted pixels closed. `disparity`
/// may be smaller than the mask by a whole factor, its values then being in its own pixels; it is
/// not empty.
cv::Mat1b ShiftMaskToRight(const cv::Mat1b& mask, const cv::Mat1f& disparity);

}  // namespace aisle::slam
