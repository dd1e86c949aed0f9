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
  std::int64_t id = 0;  ///< as in StereoImages, as is the stamp
  std::int64_t stamp_ns = 0;
  TrackingState state = TrackingState::kInitializing;
  /// Maps rig coordinates to world coordinates, metres: the rig is the left rectified camera, x
  /// right, y down, z forward. The world is the rig at the first pose, or that of map_file; it
  /// stays where it is for as long as map_id stays the same. Present exactly in kTracking and
  /// kCoasting.
  std::optional<Eigen::Isometry3d> T_world_rig;
  /// Which world T_world_rig is of: 0 at first, one more each time that the system gives up a map
  /// which was still small when it was lost (never that of map_file) and begins another. Poses of
  /// different ids are of different worlds; Finish knows those of the last one alone. Where the new
  /// world lies in the former is not known: Base::kOrbSlam2 begins it at the identity,
  /// Base::kPlain where it guesses the rig to be by its motion before the loss.
  int map_id = 0;
  int features = 0;        ///< keypoints in the left image after rejection
  int stereo_points = 0;   ///< of them, those with depth
  int matched_points = 0;  ///< matched to the map, in either image; a landmark counts once
  int inliers = 0;         ///< kept by pose refinement
  bool is_keyframe = false;
  int map_keyframes = 0;   ///< size of the map after this frame: it grows with the place ...
  int map_landmarks = 0;   ///< ... that has been explored, not with time
  DynamicRegions dynamic;  ///< what the system itself rejected as moving; empty without a method
  /// For DrawStages (slam/moving_objects.h); null unless SlamOptions::dynamic.keep_stages.
  std::shared_ptr<const DynamicStages> dynamic_stages;
  bool loop_closed = false;  ///< from this frame on the map is as a closed loop has corrected it
  /// Pixels of the left image (the centre of pixel (0, 0) is x = 0, y = 0), for scoring where
  /// features were spent.
  std::vector<cv::Point2f> keypoints;
  std::vector<bool> keypoint_is_inlier;    ///< per keypoint: took part in the pose
  std::map<std::string, double> stage_ms;  ///< wall time by stage, ms; nothing depends on it
};

/// The face of the SLAM system. One instance per sequence; any number of instances per process,
/// each used from one thread at a time. Same images, same options: the same bits out, for any
/// number of threads.
class StereoSlam {
 public:
  /// Throws std::invalid_argument for a camera or options that break a rule, with the rule;
  /// std::runtime_error for a map or vocabulary file that cannot be read, or a map that was made
  /// with another camera or another feature.scale.
  StereoSlam(const StereoCamera& camera, const SlamOptions& options);
  StereoSlam(StereoSlam&&) noexcept;
  StereoSlam& operator=(StereoSlam&&) noexcept;
  ~StereoSlam();

  /// Finds the rig in the map, and the map grows.
  ///
  /// Throws std::invalid_argument for images or masks of another size than the camera's, a
  /// confidence or a motion that is not finite, a covariance that is not symmetric and positive
  /// definite, and a stamp that is not after the one before; nothing is changed then. Hard frames
  /// (black, featureless) are not errors: they come back as kLost or kInitializing.
  ///
  /// `motion`, where something other than the images measures it: how the rig has moved since the
  /// frame before. Base::kPlain then believes no pose that contradicts it, and where movers or
  /// darkness leave too little of the map it goes by it (kCoasting) until the map is seen again. A
  /// frame without one ends that. Base::kOrbSlam2, like the published system, does without.
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
  /// re-anchored to its reference keyframe as the finished map has it: stamps rise, and frames
  /// that were never placed are missing. It is of the last world (TrackedFrame::map_id) and, where
  /// parts of the map have never been joined, of the largest one.
  std::vector<StampedPose> Finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Trains the visual words that loop closing and relocalisation recognise places by, from images of
/// places like those that will be seen, and writes them to `file` (SlamOptions::vocabulary_file).
/// The same images (8-bit grey, any sizes) in the same order give the same file. Returns the number
/// of words. Throws std::runtime_error where the file cannot be written.
int TrainVocabulary(const std::vector<cv::Mat1b>& images, const FeatureOptions& options,
                    const std::string& file);

}  // namespace aisle::slam
