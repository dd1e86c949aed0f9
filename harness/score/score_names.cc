#include "harness/score/score_names.h"

#include <algorithm>

namespace aisle {
namespace {

/// One description for each statistic of a sample of errors.
void AddStatistics(const std::string& prefix, const std::string& what,
                   std::vector<ScoreDescription>* names) {
  for (const auto& [statistic, word] :
       {std::pair("rmse", "root mean square"), std::pair("mean", "mean"),
        std::pair("median", "median"), std::pair("std", "standard deviation"),
        std::pair("min", "smallest"), std::pair("max", "largest")}) {
    names->push_back({prefix + "_" + statistic + "_m", "m", std::string(word) + " of " + what});
  }
}

void AddTrajectory(std::vector<ScoreDescription>* names) {
  AddStatistics("ate", "the final track's distance from truth, aligned by SE(3)", names);
  names->push_back({"ate_rot_rmse_deg", "deg",
                    "root mean square of the final track's rotation error, aligned alike"});
  names->push_back({"ate_live_rmse_m", "m", "ATE of the poses as known at each frame"});
  for (const auto& [prefix, span] :
       {std::pair("rpe", "from frame to frame"), std::pair("rpe_1m", "over one metre of path"),
        std::pair("rpe_1s", "over one second")}) {
    AddStatistics(std::string(prefix) + "_trans", std::string("the error of motion ") + span,
                  names);
    names->push_back({std::string(prefix) + "_rot_rmse_deg", "deg",
                      std::string("root mean square of the error of turning ") + span});
  }
  for (const auto& [suffix, lengths] :
       {std::pair("", "KITTI's segments of 100 to 800 m"), std::pair("_short", "short segments")}) {
    names->push_back({std::string("t_rel") + suffix + "_percent", "%",
                      std::string("translation error over ") + lengths});
    names->push_back({std::string("r_rel") + suffix + "_deg_per_100m", "deg/100m",
                      std::string("rotation error over ") + lengths});
  }
  names->push_back({"coverage", "1", "share of frames with a pose", true});
  names->push_back({"times_lost", "1", "how often tracking was lost"});
  names->push_back({"recovery_max_s", "s", "longest time from losing the track to the next pose"});
  for (const char* quantile : {"50", "95"}) {
    names->push_back({std::string("error_all_p") + quantile + "_m", "m",
                      std::string("quantile ") + quantile +
                          " % of the error over all frames, lost ones counted as failures"});
  }
  names->push_back({"dynamic_penalty", "1", "ATE of this run over that of its empty twin"});
}

void AddMasks(std::vector<ScoreDescription>* names) {
  const std::vector<ScoreDescription> masks = {
      {"mask_precision", "1", "share of the rejected pixels that move", true},
      {"mask_recall", "1", "share of the moving pixels that are rejected", true},
      {"mask_iou", "1", "intersection over union of rejected and moving pixels", true},
      {"mask_boundary_f", "1", "F-measure of the mask's outline (DAVIS)", true},
      {"object_precision", "1",
       "share of the rejected regions that are moving objects, parts of such left out", true},
      {"object_recall", "1", "share of the moving objects that are found by their rectangle", true},
      {"object_iou", "1", "mean IoU of the rectangles of found objects", true},
      {"object_covered", "1", "share of the moving objects most of whose pixels are rejected",
       true},
      {"object_precision_large", "1", "share of the large regions that cover something moving",
       true},
      {"object_recall_large", "1", "recall of objects of 1 % of the image at 0.15 m/s or more",
       true},
      {"object_covered_large", "1",
       "object_covered of objects of 1 % of the image at 0.15 m/s or more", true},
      {"object_recall_size_*", "1", "recall of objects by their pixels", true},
      {"object_recall_distance_*", "1", "recall of objects by their distance", true},
      {"object_recall_speed_*", "1", "recall of objects by their speed", true},
      {"object_recall_class_*", "1", "recall of objects by their class", true},
      {"objects_moving", "1", "moving objects, summed over frames"},
      {"objects_found", "1", "moving objects found by their rectangle, summed over frames"},
      {"objects_missed", "1", "moving objects not found by their rectangle, summed over frames"},
      {"objects_invented", "1", "rejected regions without a moving object, summed over frames"},
      {"static_features_lost", "1", "share of the corners on static surfaces that are rejected",
       true},
  };
  names->insert(names->end(), masks.begin(), masks.end());
  for (const char* kind : {"large", "slow"}) {
    const std::string mover = std::string("mover_") + kind + "_";
    const std::string movers = std::string(kind) + " movers";
    names->push_back(
        {mover + "found", "1", "share of the " + movers + " that are ever found", true});
    names->push_back({mover + "found_within_*", "1", "share of them found within that time", true});
    names->push_back({mover + "delay_median_s", "s", "median time until they are found"});
    names->push_back({mover + "delay_max_s", "s", "longest time until one is found"});
    names->push_back({mover + "gap_max_frames", "frames", "longest loss of one once found"});
    names->push_back(
        {mover + "gap_turning_max_frames", "frames", "the same, of frames in which the rig turns"});
  }
}

void AddFrames(std::vector<ScoreDescription>* names) {
  const std::vector<ScoreDescription> frames = {
      {"features_on_movers", "1", "share of the features that sit on moving surfaces", true},
      {"inliers_on_movers_per_frame", "1",
       "features on moving surfaces that the pose was computed from, per frame"},
      {"difficulty_movers_share", "1", "share of the image that moves", true},
      {"difficulty_static_texture_share", "1", "share of it that stands still and shows texture",
       true},
      {"difficulty_flow_px", "px", "median motion of static points from frame to frame"},
      {"difficulty_blur_px", "px", "motion of static points during the exposure"},
      {"difficulty_parallax_px", "px",
       "part of the static points' motion that is due to translation"},
      {"ms_*_mean", "ms", "mean wall time of that stage over the frames that had it"},
      {"peak_rss_mib", "MiB", "peak of resident memory"},
  };
  names->insert(names->end(), frames.begin(), frames.end());
}

const std::vector<ScoreDescription>& DriveScoreNames() {
  static const std::vector<ScoreDescription> drive = {
      {"goal_reached", "1", "1 where the vehicle of a closed drive ended within its goal's bounds",
       true},
      {"route_completion", "1", "share of the planned route that it drove", true},
      {"cross_track_rms_m", "m", "root mean square of the true vehicle's distance from its route"},
      {"cross_track_max_m", "m", "largest distance of the true vehicle from its route"},
      {"heading_error_max_deg", "deg", "largest turn of the true vehicle from its route"},
      {"belief_error_rms_m", "m",
       "root mean square of where it believed to be from where it was; by a taught way the map's "
       "own error is in it"},
      {"belief_error_max_m", "m", "largest distance of belief and truth, likewise"},
      {"docking_error_m", "m", "distance of the vehicle from its goal at the end"},
      {"docking_error_deg", "deg", "turn of the vehicle from its goal at the end"},
      {"cross_track_truth_steered_rms_m", "m", "cross_track_rms_m of the truth-steered twin"},
      {"cross_track_truth_steered_max_m", "m", "cross_track_max_m of the truth-steered twin"},
      {"docking_error_truth_steered_m", "m", "docking_error_m of the truth-steered twin"},
      {"drive_time_s", "s", "time until the drive ended, or until now while it is under way"},
      {"time_over_planned", "1", "that time over the planned one"},
      {"stops", "1", "protective stops, because the system was lost for too long"},
      {"scanner_stops", "1", "stops by the safety scanner, where one is switched on"},
      {"stopped_s", "s", "time held by protective or scanner stops"},
      {"lost_s", "s", "time without a pose to steer by"},
      {"frames_dropped", "1", "share of the camera's frames that the busy system never saw", true},
      {"collisions", "1",
       "contacts of the moving vehicle; with a person who touched it at rest, from when it moves "
       "towards him"},
      {"collisions_static", "1", "collisions with racks, walls, columns, goods and the like"},
      {"collisions_person", "1", "collisions with people"},
      {"collisions_vehicle", "1", "collisions with other vehicles, trailers and mechanisms"},
      {"collision_speed_max_mps", "m/s",
       "speed of the vehicle's fastest corner in its fastest collision"},
      {"min_clearance_static_m", "m", "smallest distance of the footprint from static objects"},
      {"min_clearance_person_m", "m", "smallest distance from a person while moving"},
      {"min_clearance_vehicle_m", "m", "smallest distance from another vehicle while moving"},
      {"time_to_collision_min_s", "s", "smallest gap over closing speed to a person or vehicle"},
      {"zone_violations", "1", "times the vehicle was too fast in a zone, or in one closed to it"},
  };
  return drive;
}

bool Matches(const std::string& name, const std::string& pattern) {
  const std::size_t star = pattern.find('*');
  if (star == std::string::npos) return name == pattern;
  const std::string head = pattern.substr(0, star), tail = pattern.substr(star + 1);
  return name.size() > head.size() + tail.size() && name.starts_with(head) && name.ends_with(tail);
}

const ScoreDescription* Describe(const std::string& name) {
  const auto& names = ScoreNames();
  const auto found = std::ranges::find_if(
      names, [&](const ScoreDescription& known) { return Matches(name, known.name); });
  return found == names.end() ? nullptr : &*found;
}

}  // namespace

const std::vector<ScoreDescription>& ScoreNames() {
  static const std::vector<ScoreDescription> names = [] {
    std::vector<ScoreDescription> all;
    AddTrajectory(&all);
    AddMasks(&all);
    AddFrames(&all);
    all.insert(all.end(), DriveScoreNames().begin(), DriveScoreNames().end());
    return all;
  }();
  return names;
}

bool IsScoreName(const std::string& name) { return Describe(name) != nullptr; }

std::string UnitOf(const std::string& name) {
  const ScoreDescription* description = Describe(name);
  return description == nullptr ? std::string() : description->unit;
}

bool IsShare(const std::string& name) {
  const ScoreDescription* description = Describe(name);
  return description != nullptr && description->is_share;
}

bool IsDriveScore(const std::string& name) {
  return std::ranges::any_of(DriveScoreNames(), [&](const auto& d) { return d.name == name; });
}

}  // namespace aisle
