#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "harness/contract/estimate.h"
#include "harness/contract/frame.h"
#include "harness/contract/score.h"
#include "harness/contract/system_spec.h"
#include "harness/contract/twin.h"

namespace aisle {

/// One cell of a suite: which system on which version of which scene.
struct RunSpec {
  std::string scene;       ///< name, e.g. "paper/scene2"
  std::string scene_file;  ///< path
  std::string twin = twin::kLive;
  SystemSpec system;
  std::uint64_t seed = 1;
  /// Which drive over this very input, from 1 on: of systems that scatter on one (`repeats`).
  int repeat = 1;

  bool operator==(const RunSpec&) const = default;
};

enum class RunStatus {
  kOk,
  kLost,     ///< fewer poses than the run asks for
  kCrashed,  ///< the system ended in a signal, an exception or an error exit
  kTimeout,  ///< out of time or memory
  kInvalid,  ///< NaN, unordered or foreign stamps
};
/// Below this share of frames with a pose a run is lost.
inline constexpr double kMinCoverage = 0.5;

/// Whether the system answered to the end, however many frames it lost; else the run has failed.
inline bool IsComplete(RunStatus status) {
  return status == RunStatus::kOk || status == RunStatus::kLost;
}

/// What became of one moving object in one frame.
struct ObjectOutcome {
  int instance = 0;  ///< the same object has the same one in every frame of a run
  std::string object_class;
  int pixels = 0;         ///< that move and show
  double share = 0;       ///< of the image that these are
  double distance_m = 0;  ///< from the rig to the centre of its 3-D box
  double speed_mps = 0;
  bool found = false;   ///< by its rectangle
  double rejected = 0;  ///< share of its moving pixels that were rejected
  bool operator==(const ObjectOutcome&) const = default;
};

/// How the mask a system rejected by compares with truth in one frame.
struct MaskFacts {
  std::int64_t true_positives = 0, false_positives = 0, false_negatives = 0;  ///< pixels
  int objects_found = 0, objects_invented = 0, objects_missed = 0;            ///< by rectangle
  int parts_of_movers = 0;       ///< rejected rectangles that are neither found nor invented
  int large_regions = 0;         ///< rejected over much of the image
  int large_regions_astray = 0;  ///< of them, those that cover no mover
  double iou_sum = 0;            ///< of the found objects' rectangles
  int static_corners = 0;        ///< image corners on surfaces that do not move
  int static_corners_lost = 0;   ///< of them, under the mask
  int corners_rejected = 0;      ///< all image corners under the mask
  std::int64_t outline_truth = 0, outline_truth_met = 0;  ///< pixels of truth's outline; near ours
  std::int64_t outline_rejected = 0, outline_rejected_met = 0;  ///< and the other way round
  std::vector<ObjectOutcome> objects;  ///< those asked for; empty where no labels are known
  bool operator==(const MaskFacts&) const = default;

  /// Counts of more frames.
  MaskFacts& operator+=(const MaskFacts& more) {
    true_positives += more.true_positives;
    false_positives += more.false_positives;
    false_negatives += more.false_negatives;
    objects_found += more.objects_found;
    objects_invented += more.objects_invented;
    objects_missed += more.objects_missed;
    parts_of_movers += more.parts_of_movers;
    large_regions += more.large_regions;
    large_regions_astray += more.large_regions_astray;
    iou_sum += more.iou_sum;
    static_corners += more.static_corners;
    static_corners_lost += more.static_corners_lost;
    corners_rejected += more.corners_rejected;
    outline_truth += more.outline_truth;
    outline_truth_met += more.outline_truth_met;
    outline_rejected += more.outline_rejected;
    outline_rejected_met += more.outline_rejected_met;
    objects.insert(objects.end(), more.objects.begin(), more.objects.end());
    return *this;
  }
};

/// How hard a frame is for any system; absent parts are not known.
struct Difficulty {
  /// Share of the image that stands still and shows texture: what a system could hold on to.
  std::optional<double> static_texture_share = {};
  /// Median motion of static points in the image since the frame before, pixels.
  std::optional<double> flow_px = {};
  std::optional<double> blur_px = {};      ///< how far the exposure smears them, pixels
  std::optional<double> parallax_px = {};  ///< the part of it that the rig's translation made
};

/// Truth of one frame as the scores need it (images live only while the frame is driven).
struct FrameFacts {
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d T_world_rig = Eigen::Isometry3d::Identity();  ///< truth
  double movers_share = 0;                                        ///< dynamic pixels / pixels
  double actors_share = 0;        ///< pixels of what may move / pixels
  int features = 0;               ///< the system's keypoints in the left image
  int features_on_movers = 0;     ///< of them, on dynamic pixels
  int inliers_on_movers = 0;      ///< of those, used in the pose
  std::optional<MaskFacts> mask;  ///< absent where nothing was masked or nothing is known
  Difficulty difficulty;
  double render_ms = 0;   ///< making or fetching the frame
  double process_ms = 0;  ///< the system's whole step
};

/// All that one run left behind.
struct RunResult {
  RunSpec spec;
  RunStatus status = RunStatus::kOk;
  std::string status_why;
  std::vector<FrameFacts> facts;         ///< one per frame of the sequence
  std::vector<FrameEstimate> estimates;  ///< one per frame, masks and keypoints dropped
  Trajectory truth;                      ///< one per frame
  TrajectoryEstimate trajectory;
  double wall_s = 0;
  double peak_rss_mib = 0;
  std::uint64_t scene_hash = 0;
  int threads = 0;
  std::string system_version = {};      ///< what a foreign system says it is
  std::string last_words = {};          ///< the last lines of what it printed, harmless text
  std::vector<std::string> notes = {};  ///< what a reader must know besides
};

}  // namespace aisle
