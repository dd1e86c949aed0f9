#include "harness/report/page/scene_tables.h"

#include <numeric>
#include <set>
#include <span>

#include "harness/record/seed_values.h"
#include "harness/report/markup/html.h"
#include "harness/report/page/parts.h"
#include "harness/score/statistics.h"

namespace aisle {
namespace {

struct Column {
  const char* title;
  const char* score;
  double factor;
  int decimals;
  /// Of what happens in some drives and not in others: a median of yes and no hides up to half.
  bool is_mean = false;
};
constexpr Column kColumns[] = {
    {"ATE RMSE<br>[cm]", "ate_rmse_m", 100, 2},
    {"ATE max<br>[cm]", "ate_max_m", 100, 2},
    {"live ATE<br>[cm]", "ate_live_rmse_m", 100, 2},
    {"95 % of frames<br>within [cm]", "error_all_p95_m", 100, 2},
    {"RPE 1 s<br>[cm]", "rpe_1s_trans_rmse_m", 100, 2},
    {"RPE 1 s<br>[deg]", "rpe_1s_rot_rmse_deg", 1, 3},
    {"coverage<br>[%]", "coverage", 100, 1},
    {"features on<br>movers [%]", "features_on_movers", 100, 2},
    {"used on movers<br>per frame", "inliers_on_movers_per_frame", 1, 1},
    {"step<br>[ms]", "ms_process_mean", 1, 1},
};
constexpr Column kMaskColumns[] = {
    {"object<br>precision [%]", "object_precision", 100, 1},
    {"object<br>recall [%]", "object_recall", 100, 1},
    {"object<br>IoU [%]", "object_iou", 100, 1},
    {"large movers<br>precision [%]", "object_precision_large", 100, 1},
    {"large movers<br>recall [%]", "object_recall_large", 100, 1},
    {"large movers<br>covered [%]", "object_covered_large", 100, 1},
    {"pixel<br>precision [%]", "mask_precision", 100, 1},
    {"pixel<br>recall [%]", "mask_recall", 100, 1},
    {"pixel<br>IoU [%]", "mask_iou", 100, 1},
    {"static features<br>lost [%]", "static_features_lost", 100, 2},
};

constexpr Column kDriveColumns[] = {
    {"drives that reach<br>their goal [%]", "goal_reached", 100, 0, true},
    {"docking<br>[mm]", "docking_error_m", 1000, 1},
    {"docking<br>[deg]", "docking_error_deg", 1, 2},
    {"off the route,<br>rms [cm]", "cross_track_rms_m", 100, 2},
    {"largest<br>[cm]", "cross_track_max_m", 100, 2},
    {"largest, told<br>the truth [cm]", "cross_track_truth_steered_max_m", 100, 2},
    {"open-loop error:<br>live ATE [cm]", "ate_live_rmse_m", 100, 2},
    {"touches<br>a drive", "collisions", 1, 1, true},
    {"least clearance,<br>things [m]", "min_clearance_static_m", 1, 2},
    {"people [m]", "min_clearance_person_m", 1, 2},
    {"time over<br>planned", "time_over_planned", 1, 2},
    {"stops", "stops", 1, 0},
    {"without a<br>pose [s]", "lost_s", 1, 1},
    {"frames not<br>seen [%]", "frames_dropped", 100, 0},
};

constexpr Column kContinuityColumns[] = {
    {"large: found<br>in 1 s [%]", "mover_large_found_within_1s", 100, 1},
    {"large: delay,<br>median [s]", "mover_large_delay_median_s", 1, 2},
    {"large: delay,<br>max [s]", "mover_large_delay_max_s", 1, 2},
    {"large: longest<br>gap [frames]", "mover_large_gap_max_frames", 1, 0},
    {"large: gap in<br>turns [frames]", "mover_large_gap_turning_max_frames", 1, 0},
    {"slow: found<br>in 1 s [%]", "mover_slow_found_within_1s", 100, 1},
    {"slow: delay,<br>median [s]", "mover_slow_delay_median_s", 1, 2},
    {"slow: delay,<br>max [s]", "mover_slow_delay_max_s", 1, 2},
    {"slow: longest<br>gap [frames]", "mover_slow_gap_max_frames", 1, 0},
    {"slow: gap in<br>turns [frames]", "mover_slow_gap_turning_max_frames", 1, 0},
};

/// Those in which any system has a number.
std::vector<Column> Filled(const std::vector<SystemRuns>& systems,
                           std::span<const Column> columns) {
  std::vector<Column> filled;
  std::ranges::copy_if(columns, std::back_inserter(filled), [&](const Column& column) {
    return std::ranges::any_of(systems, [&](const SystemRuns& system) {
      return !ScoresOf(system.runs, column.score).empty();
    });
  });
  return filled;
}

double Mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// The median, or mean, of the seeds that have the score; how many these are where some have not,
/// and whether it was computed from something else than its name says.
std::string ScoreCell(const SystemRuns& system, const Column& column) {
  const std::vector<double> values = ScoresOf(system.runs, column.score);
  if (values.empty()) return "<td>-";
  const bool derived = std::ranges::any_of(system.runs, [&](const RunRecord* run) {
    const auto score = run->scores.find(column.score);
    return score != run->scores.end() && score->second.value && !score->second.basis.empty();
  });
  const double value = column.is_mean ? Mean(values) : Quantile(values, 0.5);
  std::string cell =
      fmt::format("<td>{}{:.{}f}", derived ? "≈" : "", value * column.factor, column.decimals);
  if (const std::size_t seeds = CountSeeds(system.runs); values.size() < seeds) {
    cell += fmt::format(" <span class=\"fail\">{}/{}</span>", values.size(), seeds);
  }
  return cell;
}

std::string ScoreTable(const std::vector<SystemRuns>& systems, std::span<const Column> columns) {
  std::string text = "<div class=\"wide\"><table><tr><th>system";
  for (const Column& column : columns) text += fmt::format("<th>{}", column.title);
  text += "\n";
  for (const SystemRuns& system : systems) {
    text += "<tr><td>" + NameOf(system);
    for (const Column& column : columns) text += ScoreCell(system, column);
    text += "\n";
  }
  return text + "</table></div>\n";
}

/// The systems with a run that has any score of that beginning.
std::vector<SystemRuns> WithScores(const std::vector<SystemRuns>& systems,
                                   const std::string& beginning) {
  std::vector<SystemRuns> chosen;
  for (const SystemRuns& system : systems) {
    const bool has = std::any_of(system.runs.begin(), system.runs.end(), [&](const RunRecord* run) {
      const auto first = run->scores.lower_bound(beginning);
      return first != run->scores.end() && first->first.starts_with(beginning);
    });
    if (has) chosen.push_back(system);
  }
  return chosen;
}

/// "3", "3r2": as in the run's id.
std::string ShortSeed(const RunSpec& spec) {
  const std::string id = RunId(spec);
  return id.substr(id.rfind('/') + 1);
}

/// What every run says of one score; unit and alignment are those of the first that has it, the
/// reason why there is none is that of the first that has not.
std::string ScoreRow(const std::string& name, const std::vector<const RunRecord*>& runs) {
  std::string cells, unit, alignment, absent;
  for (const RunRecord* run : runs) {
    const auto score = run->scores.find(name);
    if (score != run->scores.end() && score->second.value) {
      cells += fmt::format("<td>{:.5g}", *score->second.value);
      unit = score->second.unit;
      alignment = score->second.alignment;
      continue;
    }
    cells += "<td>-";
    if (absent.empty() && score != run->scores.end()) absent = score->second.absent;
  }
  if (!absent.empty()) cells += "<td class=\"left soft\">-: " + Escape(absent);
  return fmt::format("<tr><td>{}<td>{}<td>{}{}\n", Escape(name), Escape(unit), Escape(alignment),
                     cells);
}

}  // namespace

std::string ErrorTable(const std::vector<SystemRuns>& systems) {
  std::string text = ScoreTable(systems, kColumns);
  const bool derived = text.find("≈") != std::string::npos;
  text +=
      "<p class=\"soft small\">Medians over seeds, errors in centimetres after rigid alignment; "
      "RPE over one second, every start; 95 % of frames counts lost frames as failures.";
  if (derived) text += " ≈: the wall time of the whole process over its frames.";
  return text + "</p>\n";
}

std::string DriveTable(const std::vector<SystemRuns>& systems) {
  return ScoreTable(systems, kDriveColumns) +
         "<p class=\"soft small\">Medians over seeds, of the true vehicle; goals and touches are "
         "means over all of them. Told the truth: the "
         "same "
         "vehicle and driver at the same latency with perfect poses. ATE: of the same drive's "
         "poses, "
         "after rigid alignment, which a vehicle has not.</p>\n";
}

std::string MaskTables(const std::vector<SystemRuns>& systems) {
  std::string text;
  if (const auto masked = WithScores(systems, "mask_iou"); !masked.empty()) {
    text +=
        "<h3>What was rejected</h3>\n" + ScoreTable(masked, kMaskColumns) +
        "<p class=\"soft small\">Objects are compared by rectangle: found where the overlap (IoU) "
        "is "
        "0.5 or more, false where less than half of what was rejected moves. Large movers: recall "
        "of those of at least 1 % of the image and 0.15 m/s; precision: the share of regions of "
        "that size of which at least a tenth moves; covered: at least half of their moving pixels "
        "rejected, whatever the rectangles (people who touch make one). Pixels are counted over "
        "all frames together; static features lost: share of the image corners on static surfaces "
        "that the mask covers.</p>\n";
  }
  if (const auto followed = WithScores(systems, "mover_"); !followed.empty()) {
    text +=
        "<h3>How movers were followed</h3>\n" +
        ScoreTable(followed, Filled(followed, kContinuityColumns)) +
        "<p class=\"soft small\">Each time that something is a large mover as above, or as large "
        "and slow (0.05 to 0.15 m/s): found once at least half of its moving pixels are rejected. "
        "Delay: until then, of those that stay 1 s or longer; one that is never found counts with "
        "all its time, the least it would have taken. Longest gap: frames in a row in which one "
        "once found is lost; in turns: how many frames of a gap the rig turns in, at 10 degrees a "
        "second or faster. Max and longest: the worst mover of a run.</p>\n";
  }
  return text;
}

/// Closing tags of cells and rows are left out, as HTML allows: a night has thousands of them.
std::string AllScores(const SceneRuns& scene) {
  std::vector<const RunRecord*> runs;
  std::set<std::string> names;
  std::string head;
  for (const SystemRuns& system : scene.systems) {
    for (const RunRecord* run : system.runs) {
      runs.push_back(run);
      for (const auto& [name, score] : run->scores) names.insert(name);
      head += fmt::format("<th>{} {}", Escape(system.system), ShortSeed(run->spec));
    }
  }
  std::string text =
      "<details><summary>every score of every run</summary><div class=\"wide\"><table "
      "class=\"dense\"><tr><th>score<th class=\"left\">unit<th class=\"left\">alignment" +
      head + "\n";
  for (const std::string& name : names) text += ScoreRow(name, runs);
  return text + "</table></div></details>\n";
}

}  // namespace aisle
