#include <set>
#include <span>

#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/record/frames_csv.h"
#include "harness/report/chart/charts.h"
#include "harness/report/chart/simplify.h"
#include "harness/report/chart/time_chart.h"
#include "harness/report/markup/html.h"
#include "harness/report/page/page.h"
#include "harness/report/page/stage_section.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

struct Column {
  const char* title;
  const char* score;
  double factor;
  int decimals;
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
      return MedianScore(system.runs, column.score).has_value();
    });
  });
  return filled;
}

std::string ScoreTable(const std::vector<SystemRuns>& systems, std::span<const Column> columns) {
  std::string text = "<div class=\"wide\"><table><tr><th>system";
  for (const Column& column : columns) text += fmt::format("<th>{}", column.title);
  text += "\n";
  for (const SystemRuns& system : systems) {
    text += fmt::format("<tr><td><span class=\"chip c{}\"></span>{}", system.color % 6,
                        Escape(system.system));
    for (const Column& column : columns) {
      const auto value = MedianScore(system.runs, column.score);
      text += fmt::format(
          "<td>{}", value ? fmt::format("{:.{}f}", *value * column.factor, column.decimals) : "-");
    }
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

std::string MaskTables(const std::vector<SystemRuns>& systems) {
  std::string text;
  if (const auto masked = WithScores(systems, "mask_iou"); !masked.empty()) {
    text +=
        "<h3>What was rejected</h3>\n" + ScoreTable(masked, kMaskColumns) +
        "<p class=\"soft small\">Objects by rectangle, found where the overlap (IoU) is 0.5 or "
        "more, invented where less than half of what was rejected moves. Large movers: recall of "
        "those of 1 % of the image or more at 0.15 m/s or more; precision: the share of "
        "regions of that size of which a tenth or more moves; covered: at least half of their "
        "moving pixels rejected, whatever the rectangles (people who touch make one). Pixels "
        "over all frames together; static features lost: share of image corners "
        "on unmoving surfaces under the mask.</p>\n";
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

std::string Troubles(const std::vector<SystemRuns>& systems) {
  std::string text;
  for (const SystemRuns& system : systems) {
    for (const RunRecord* run : system.runs) {
      if (run->status != RunStatus::kOk) {
        text += fmt::format("<p><span class=\"fail\">{}</span> {}, seed {}: {}</p>\n",
                            Name(run->status), Escape(system.system), run->spec.seed,
                            Escape(run->status_why));
      }
      for (const std::string& note : run->notes) {
        text += fmt::format("<p>{}, seed {}: {}</p>\n", Escape(system.system), run->spec.seed,
                            Escape(note));
      }
    }
  }
  return text;
}

std::string Figure(const std::string& content, const std::string& caption) {
  if (content.empty()) return "";
  return "<figure>" + content + "<figcaption>" + caption + "</figcaption></figure>\n";
}

/// "color x y z dx dy dz …": the first point and the steps from there on, in millimetres.
std::string TrackData(int color, const std::vector<Eigen::Vector3d>& points_m, double tolerance_m) {
  std::string data = fmt::format("{}", color);
  Eigen::Vector3d at_mm = Eigen::Vector3d::Zero();
  for (const std::size_t i : Simplify(points_m, tolerance_m)) {
    const Eigen::Vector3d mm = (1000 * points_m[i]).array().round();
    const Eigen::Vector3d step = mm - at_mm;
    data += fmt::format(" {:.0f} {:.0f} {:.0f}", step.x(), step.y(), step.z());
    at_mm = mm;
  }
  return data;
}

/// The tracks in three dimensions, for pages whose scripts may run: hidden without.
std::string Orbit(const std::vector<ChartSeries>& series) {
  if (series.empty()) return "";
  std::vector<Eigen::Vector3d> truth;
  Eigen::AlignedBox3d box;
  for (const FrameRow& row : *series.front().rows) truth.push_back(row.truth_m);
  for (const Eigen::Vector3d& at : truth) box.extend(at);
  const double tolerance_m = box.diagonal().norm() / 2000;
  std::string tracks = TrackData(-1, truth, tolerance_m);
  for (const ChartSeries& one : series) {
    std::vector<Eigen::Vector3d> live;
    for (const FrameRow& row : *one.rows) {
      if (row.live_m) live.push_back(*row.live_m);
    }
    if (live.size() < 2) continue;
    tracks += ';';
    tracks += TrackData(one.color, live, tolerance_m);
  }
  return fmt::format(
      "<figure hidden data-tracks=\"{}\"><figcaption>The tracks in space: drag to turn, wheel to "
      "come closer.</figcaption></figure>\n",
      tracks);
}

std::string Spread(const SceneRuns& scene) {
  std::vector<SpreadRow> rows;
  bool several = false;
  for (const SystemRuns& system : scene.systems) {
    SpreadRow row{system.system, system.color % 6, {}};
    for (const RunRecord* run : system.runs) {
      const auto score = run->scores.find("ate_rmse_m");
      if (score != run->scores.end() && score->second.value) {
        row.values.push_back(100 * *score->second.value);
      }
    }
    several = several || row.values.size() > 1;
    rows.push_back(row);
  }
  if (!several) return "";
  return Figure(SpreadChart(rows, "ATE RMSE [cm]"),
                "A dot per seed, the box holds the middle half, the median as a line.");
}

/// Times that are no stage of the system's own, or sums of such stages.
const std::set<std::string> kNoStages = {"process", "render", "total", "tracking", "front_end"};

std::string Stages(const SceneRuns& scene) {
  std::vector<StageRow> rows;
  for (const SystemRuns& system : scene.systems) {
    StageRow row{system.system, {}};
    int color = 0;
    for (const auto& [name, score] : system.runs.front()->scores) {
      if (!name.starts_with("ms_") || !score.value) continue;
      const std::string stage = name.substr(3, name.size() - 3 - std::string("_mean").size());
      if (kNoStages.contains(stage)) continue;
      row.bars.push_back({stage, color++, *MedianScore(system.runs, name)});
    }
    if (!row.bars.empty()) rows.push_back(row);
  }
  if (rows.empty()) return "";
  return Figure(
      StageChart(rows),
      "What the system says of its own stages, mean over the frames that had them. Mapping, "
      "loop closing and global adjustment run beside the frames and in few of them: they "
      "do not add up to the step.");
}

/// The drive over time on one side, everything else beside it where the screen is wide.
std::string Charts(const SceneRuns& scene, const fs::path& report_dir) {
  std::vector<FrameFile> frames;
  std::string troubles;
  for (const SystemRuns& system : scene.systems) {  // its first seed stands for a system
    frames.push_back(ReadFrameFile(*system.runs.front(), report_dir));
    if (frames.back().trouble.empty()) continue;
    troubles += fmt::format("<p>{} is not in the charts: {}</p>\n", Escape(system.system),
                            Escape(frames.back().trouble));
  }
  std::vector<ChartSeries> series;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].rows.empty()) continue;
    series.push_back({scene.systems[i].system, scene.systems[i].color % 6, &frames[i].rows});
  }
  const std::string seed = fmt::format("Seed {}. ", scene.systems.front().runs.front()->spec.seed);
  return troubles + "<div class=\"charts\">" +
         Figure(TimeChart(series),
                seed +
                    "Distance of each live pose from truth after rigid alignment; gaps are frames "
                    "without a pose. Beneath, from truth: what moves in the left image, what each "
                    "system rejected of its corners, and how hard the frame is for anybody.") +
         "<div>" + Figure(TopViewChart(series), seed + "Live tracks from above, truth dashed.") +
         Orbit(series) + Spread(scene) + Stages(scene) + "</div></div>\n";
}

std::string Pictures(const SceneRuns& scene, const std::string& root) {
  std::string text;
  for (const SystemRuns& system : scene.systems) {
    std::string images;
    for (const auto& [name, path] : system.runs.front()->artifacts) {
      if (!name.starts_with("picture_")) continue;
      const std::string url = root + EscapeUrl(path);
      images += fmt::format(
          "<a href=\"{0}\"><img src=\"{0}\" loading=\"lazy\" width=\"752\" height=\"504\" "
          "alt=\"left image with truth and estimate, {1}\"></a>\n",
          url, Escape(system.system));
    }
    if (images.empty()) continue;
    text += fmt::format(
        "<h3><span class=\"chip c{}\"></span>{}</h3>\n<div class=\"pictures\">{}</div>\n",
        system.color % 6, Escape(system.system), images);
  }
  if (text.empty()) return "";
  return "<p class=\"small soft\"><span class=\"chip red\"></span>moves now (truth) &nbsp; <span "
         "class=\"chip blue\"></span>person or vehicle at rest &nbsp; <span class=\"chip cyan\">"
         "</span>rejected by the system &nbsp; <span class=\"chip green\"></span>feature used "
         "&nbsp; <span class=\"chip grey\"></span>feature not used &nbsp; <span class=\"chip "
         "yellow\"></span>feature on a mover</p>\n" +
         text;
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

/// Closing tags of cells and rows are left out, as HTML allows: a night has thousands of them.
std::string AllScores(const SceneRuns& scene) {
  std::vector<const RunRecord*> runs;
  std::set<std::string> names;
  std::string head;
  for (const SystemRuns& system : scene.systems) {
    for (const RunRecord* run : system.runs) {
      runs.push_back(run);
      for (const auto& [name, score] : run->scores) names.insert(name);
      head += fmt::format("<th>{} {}", Escape(system.system), run->spec.seed);
    }
  }
  std::string text =
      "<details><summary>every score of every run</summary><div class=\"wide\"><table "
      "class=\"dense\"><tr><th>score<th class=\"left\">unit<th class=\"left\">alignment" +
      head + "\n";
  for (const std::string& name : names) text += ScoreRow(name, runs);
  return text + "</table></div></details>\n";
}

/// The folder as a shell would be told it, seen from where the suite was started.
std::string Again(const SceneRuns& scene, const std::string& root, const std::string& place) {
  std::string text = "<h3>Files, and each run again</h3>\n<div class=\"wide\"><table>";
  for (const SystemRuns& system : scene.systems) {
    for (const RunRecord* run : system.runs) {
      text +=
          fmt::format("<tr><td>{} {}<td class=\"left\">", Escape(system.system), run->spec.seed);
      for (const auto& [name, path] : run->artifacts) {
        if (name.starts_with("picture_") || IsStageSheet(name)) continue;
        text += fmt::format("<a href=\"{}\">{}</a> ", root + EscapeUrl(path), Escape(name));
      }
      text += fmt::format("<td class=\"left\"><code>./aisle rerun {} --in {}</code>\n",
                          Escape(RunId(run->spec)), Escape(place));
    }
  }
  return text + "</table></div>\n";
}

}  // namespace

std::string SceneSection(const SceneRuns& scene, const fs::path& report_dir,
                         const std::string& root) {
  const RunRecord& first = *scene.systems.front().runs.front();
  std::string text = fmt::format(
      "<h2 id=\"{}\">{} <span class=\"soft\">{}</span></h2>\n<p class=\"soft small\">{} frames, "
      "{:g} "
      "per second, {} seed{}; content {}. Errors in centimetres after rigid alignment; RPE over "
      "one "
      "second, every start; 95 % of frames counts lost frames as failures.</p>\n",
      ScenePage(scene), Escape(scene.scene), Escape(scene.twin), first.frames, first.rate_hz,
      scene.systems.front().runs.size(), scene.systems.front().runs.size() == 1 ? "" : "s",
      Escape(first.content_hash));
  text += Troubles(scene.systems) + ScoreTable(scene.systems, kColumns) + MaskTables(scene.systems);
  text += Charts(scene, report_dir) + Pictures(scene, root) +
          StageSection(scene, report_dir, root) + AllScores(scene) +
          Again(scene, root, report_dir.string());
  return text;
}

}  // namespace aisle
