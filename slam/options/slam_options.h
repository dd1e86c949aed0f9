#pragma once

#include <string>
#include <vector>

#include "slam/dynamic/dynamic_options.h"
#include "slam/feature/feature_options.h"
#include "slam/mapping/mapping_options.h"
#include "slam/mapping/orbslam2_mapping_options.h"
#include "slam/stereo/stereo_options.h"
#include "slam/track/orbslam2_options.h"
#include "slam/track/track_options.h"

namespace aisle::slam {

/// Whose decisions track, choose keyframes and keep the map. Features, stereo, the rejection of
/// movers, matching, the optimiser, loop closing and the schedule are the same in all.
enum class Base {
  kPlain,     ///< ours
  kOrbSlam2,  ///< those of the published ORB-SLAM2, stereo (Mur-Artal and Tardos 2017)
};

/// Options of the whole system, composed of each stage's own.
struct SlamOptions {
  Base base = Base::kPlain;
  int threads = 0;  ///< 0: as many as the machine has; never changes a result
  DynamicOptions dynamic;
  FeatureOptions feature;
  StereoOptions stereo;
  TrackOptions track;  ///< of Base::kPlain, as is `keyframe`
  KeyframeOptions keyframe;
  OrbSlam2Options orbslam2;  ///< of Base::kOrbSlam2, as is `orbslam2_mapping`
  OrbSlam2MappingOptions orbslam2_mapping;
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
  int least_keyframes = 5;      ///< a smaller map is given up where a new part is begun
  std::string vocabulary_file;  ///< empty: no loop closing, and relocalisation by trying in turn
  /// Pixels of the level: deviation of a corner's position. Corners lie on whole pixels (0.3 px),
  /// the rest is what noise and changed views move them by.
  double keypoint_noise_px = 0.7;
  /// Every stereo point's right column is as exact as its left one, whatever the patches say of its
  /// disparity.
  bool equal_columns = false;
  int least_first_points = 60;  ///< stereo points of the frame that starts a map
};

/// The options that a base stands on: of what is common to all, what it has published.
SlamOptions OptionsOf(Base base);

/// Names every option that a user may set with its range, unit and a sentence, and the rules.
/// Files, threads, localise_only and how the system is run (free_running, background, keep_stages)
/// belong to whoever drives it.
void Describe(OptionFields& fields, SlamOptions& options);

/// One option as users name, set and read it.
struct OptionDescription {
  std::string path;  ///< "dynamic.robust.field.memory"
  enum class Kind { kNumber, kInteger, kFlag, kChoice, kText } kind = Kind::kNumber;
  std::string value;  ///< of the options described: shortest text that reads back to the same bits
  std::string unit;   ///< "px", "m", "frames", ...; empty: none
  std::string help;   ///< one sentence
  double low = 0, high = 0;          ///< of numbers and integers, inclusive
  std::vector<std::string> choices;  ///< of kChoice
};

/// Every option with its value in `options`, in the order of the structs.
std::vector<OptionDescription> DescribeOptions(const SlamOptions& options);

/// Sets one option from text. Returns what is wrong (path not known, with a "did you mean"; not a
/// number; out of range, with the range), or an empty string. Rules between options are left to
/// Validate: the other one may be about to be set. `base` comes first: setting it sets all others
/// to OptionsOf that base; what is set afterwards differs from it.
std::string SetOption(const std::string& path, const std::string& text, SlamOptions* options);

/// Why the option changes nothing with this base and this method of finding movers, and what would
/// mend it; an empty string where it may change something. For what a user has set: Validate and
/// SetOption do not ask.
std::string WhyWithoutEffect(const std::string& path, const SlamOptions& options);

/// The first broken rule with its path, value and bound, or an empty string.
std::string Validate(const SlamOptions& options);

}  // namespace aisle::slam
