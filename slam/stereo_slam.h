#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "slam/camera/measured_motion.h"
#include "slam/camera/stereo_camera.h"
#include "slam/dynamic/common/dynamic_regions.h"
#include "slam/frames.h"
#include "slam/options/slam_options.h"

namespace aisle::slam {

struct DynamicStages;  // slam/moving_objects.h

/// What is known of a frame at that frame, causally.
struct TrackedFrame {
  std::int64_t id = 0;
  std::int64_t stamp_ns = 0;
  TrackingState state = TrackingState::kInitializing;
  /// Absent unless kTracking or kCoasting. World: first rig pose, or that of map_file. A drive that
  /// has been lost while its map was still small gives that up (never one of map_file), and the
  /// world begins anew: the next first pose is the identity again for Base::kOrbSlam2, for
  /// Base::kPlain where the motion before the loss has led. What was told before is then of another
  /// world, and not in Finish's trajectory.
  std::optional<Eigen::Isometry3d> T_world_rig;
  int features = 0;        ///< keypoints in the left image after rejection
  int stereo_points = 0;   ///< of them, with depth
  int matched_points = 0;  ///< matched to the map
  int inliers = 0;         ///< kept by pose refinement
  bool is_keyframe = false;
  int map_keyframes = 0;   ///< size of the map after this frame: it grows with the place ...
  int map_landmarks = 0;   ///< ... that has been explored, not with time
  DynamicRegions dynamic;  ///< what the system itself rejected as moving; empty without a method
  /// For DrawStages (slam/moving_objects.h); null unless SlamOptions::dynamic.keep_stages.
  std::shared_ptr<const DynamicStages> dynamic_stages;
  bool loop_closed = false;  ///< from this frame on the map is as a closed loop has corrected it
  std::vector<cv::Point2f> keypoints;      ///< left image, for scoring where features were spent
  std::vector<bool> keypoint_is_inlier;    ///< per keypoint: took part in the pose
  std::map<std::string, double> stage_ms;  ///< wall time by stage; reported, never decided upon
};

/// The face of the SLAM system. One instance per sequence; any number of instances per process.
/// Same images, same options: the same bits out, for any number of threads.
class StereoSlam {
 public:
  /// Throws std::invalid_argument for options that break a rule, std::runtime_error for a file that
  /// cannot be used.
  StereoSlam(const StereoCamera& camera, const SlamOptions& options);
  StereoSlam(StereoSlam&&) noexcept;
  StereoSlam& operator=(StereoSlam&&) noexcept;
  ~StereoSlam();

  /// Throws std::invalid_argument for images of another size than the camera's, for a confidence
  /// that is no number, for a stamp that is not after the one before, and for a motion that is
  /// none; nothing is changed then. Hard frames (black, featureless) are not errors: they come back
  /// as kLost or kInitializing.
  ///
  /// `motion`, where something else than the images tells it: how the rig has moved since the frame
  /// before. Base::kPlain then believes no pose that contradicts it, and where movers or darkness
  /// leave too little of the map it goes by it (kCoasting) until the map is seen again. A frame
  /// without one ends that. Base::kOrbSlam2, like the published system, does without.
  TrackedFrame Track(const StereoImages& images, const ExternalMask& mask = {},
                     const std::optional<MeasuredMotion>& motion = {});

  /// Writes the map for SlamOptions::map_file of a later drive, which then goes on in it as this
  /// one would after a loss: to the last bit, given a vocabulary; without one a lost rig asks the
  /// map's keyframes by turns, and the later drive begins them anew. Throws std::runtime_error
  /// where the file cannot be written or there is no map yet.
  ///
  /// This drive goes on as well, but not as it would have done without: background work is waited
  /// for and its results taken before the frames that they were due at, the velocity and the loops
  /// that nothing else has confirmed yet are forgotten, and kCoasting becomes kLost. Best after the
  /// last frame.
  void SaveMap(const std::string& file);

  /// Ends the run: waits for background work and returns the final trajectory, every tracked frame
  /// re-anchored to its reference keyframe as the finished map has it. Where parts of the map have
  /// never been joined, it is that of the largest one.
  std::vector<StampedPose> Finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Trains the visual words that loop closing and relocalisation recognise places by, from images of
/// places like those that will be seen, and writes them to `file` (SlamOptions::vocabulary_file).
/// The same images in the same order give the same file. Returns the number of words.
int TrainVocabulary(const std::vector<cv::Mat1b>& images, const FeatureOptions& options,
                    const std::string& file);

}  // namespace aisle::slam
