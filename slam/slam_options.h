#pragma once

#include <string>

#include "slam/dynamic/dynamic_options.h"
#include "slam/feature/feature_options.h"
#include "slam/map/create_landmarks.h"
#include "slam/map/cull.h"
#include "slam/map/fuse.h"
#include "slam/optimize/adjust_map.h"
#include "slam/place/find_loop.h"
#include "slam/stereo/stereo_options.h"
#include "slam/track/track_options.h"

namespace aisle::slam {

/// How a new keyframe is worked into the map.
struct MappingOptions {
  CreateLandmarksOptions create;
  CullOptions cull;
  FuseOptions fuse;
  LocalAdjustmentOptions adjust;
};

/// When background work takes effect.
struct ScheduleOptions {
  /// Frames from a keyframe to the frame that first sees what mapping made of it. A slower mapper
  /// makes that frame wait; a faster one never shows its result earlier. Hence the same bits.
  int mapping_frames = 2;
  /// Frames from the mapping result that confirms a loop to the frame that first sees it closed,
  /// and one more for every so many keyframes there are. No keyframe is made in between.
  int loop_frames = 4;
  int keyframes_per_loop_frame = 40;
  /// Frames from there to the frame that first sees the whole map adjusted, and one more for every
  /// so many keyframes. Tracking and mapping go on in between.
  int global_frames = 20;
  int keyframes_per_global_frame = 2;
  bool background = true;  ///< false: mapping runs in the caller's thread, with the same result
  /// NOT REPEATABLE. Results are taken whenever they are ready, as threads happen to run, and no
  /// frame waits: ordinary timing for those who want it. Two runs will differ.
  bool free_running = false;
};

/// Options of the whole system, composed of each stage's own.
struct SlamOptions {
  int threads = 0;  ///< 0: as many as the machine has; never changes a result
  DynamicOptions dynamic;
  FeatureOptions feature;
  StereoOptions stereo;
  TrackOptions track;
  KeyframeOptions keyframe;
  MappingOptions mapping;
  LoopOptions loop;
  GlobalAdjustmentOptions global;
  ScheduleOptions schedule;
  std::string map_file;        ///< of SaveMap; the drive goes on in that map. Empty: a new one
  bool localise_only = false;  ///< in the map of map_file, which stays as it is
  /// Seconds from the first frame that shows something and finds no pose to a new part of the map.
  /// It joins the rest when a place of it is recognised, which takes a vocabulary: without one no
  /// part is begun.
  double new_part_after_s = 1.0;
  int least_keyframes = 5;         ///< a smaller map is given up where a new part is begun
  std::string vocabulary_file;     ///< empty: no loop closing, and relocalisation by trying in turn
  double keypoint_noise_px = 1.0;  ///< pixels of the level: deviation of a corner's position
  int least_first_points = 60;     ///< stereo points of the frame that starts a map
};

/// The first broken rule with its value, or an empty string.
std::string Validate(const SlamOptions& options);

}  // namespace aisle::slam
