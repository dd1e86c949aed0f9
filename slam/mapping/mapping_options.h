#pragma once

#include "slam/common/option_fields.h"
#include "slam/feature/feature_options.h"
#include "slam/map/map_options.h"
#include "slam/optimize/optimize_options.h"
#include "slam/place/place_options.h"

namespace aisle::slam {

/// How a new keyframe is worked into the map.
struct MappingOptions {
  CreateLandmarksOptions create;
  TriangulateOptions triangulate;
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

/// Options of all work on the map.
struct MapKeeperOptions {
  int levels = FeatureOptions().levels;  ///< of the pyramids, as features are found
  MappingOptions mapping;
  LoopOptions loop;
  GlobalAdjustmentOptions global;
  ScheduleOptions schedule;
};

/// Names every option with its range, unit and a sentence.
void Describe(OptionFields& fields, MappingOptions& options);
void Describe(OptionFields& fields, ScheduleOptions& options);

}  // namespace aisle::slam
