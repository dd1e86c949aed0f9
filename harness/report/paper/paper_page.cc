#include "harness/report/paper/paper_page.h"

#include "harness/contract/twin.h"
#include "harness/record/frames_csv.h"
#include "harness/report/chart/charts.h"
#include "harness/report/chart/time_chart.h"
#include "harness/report/markup/html.h"
#include "harness/report/paper/printed.h"
#include "harness/report/paper/tables.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kTrackStep = 2;  ///< frames: a rig that drives leaves a line all the same

const SceneRuns* LiveRunsOf(const std::vector<SceneRuns>& scenes, const std::string& name) {
  for (const SceneRuns& scene : scenes) {
    if (scene.scene == name && scene.twin == twin::kLive) return &scene;
  }
  return nullptr;
}

/// The frames of every system's first seed, and the lines that lead into them.
struct Drives {
  std::vector<std::vector<FrameRow>> rows;
  std::vector<ChartSeries> series;

  /// Every so many frames.
  Drives(const SceneRuns& scene, const fs::path& report_dir, std::size_t every = 1) {
    for (const SystemRuns& system : scene.systems) {
      rows.emplace_back();
      const std::vector<FrameRow> all = ReadFrameFile(*system.runs.front(), report_dir).rows;
      for (std::size_t k = 0; k < all.size(); k += every) rows.back().push_back(all[k]);
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].empty()) continue;
      series.push_back({scene.systems[i].system, scene.systems[i].color, &rows[i]});
    }
  }
};

std::string Figure(const std::string& svg, const std::string& caption) {
  if (svg.empty()) return "";
  return "<figure>" + svg + "<figcaption>" + caption + "</figcaption></figure>\n";
}

/// Where each system stands when everybody has left.
std::string ErrorsAtTheEnd(const SceneRuns& scene, const Drives& drives) {
  std::string text;
  for (std::size_t i = 0; i < drives.rows.size(); ++i) {
    if (drives.rows[i].empty() || !drives.rows[i].back().live_error_m) continue;
    text += fmt::format("{}{} {:.3f} m", text.empty() ? "" : ", ", Escape(scene.systems[i].system),
                        *drives.rows[i].back().live_error_m);
  }
  return text;
}

std::string SceneOne(const SceneRuns& scene, const fs::path& report_dir) {
  const Drives drives(scene, report_dir);
  if (drives.series.empty()) return "";
  const std::string seed = fmt::format("Seed {}. ", scene.systems.front().runs.front()->spec.seed);
  return "<h3>Fig. 9 and 10: trajectory error and points rejected in scene 1</h3>\n<div "
         "class=\"charts\">" +
         Figure(ErrorOverFrames(drives.series),
                "Fig. 9. " + seed +
                    "The error at the last frame: " + ErrorsAtTheEnd(scene, drives) +
                    ". <i>As printed: ORB-SLAM2 begins to drift when the pedestrian comes (frame "
                    "125), drifts back when he has turned (230) and stays at 0.18 m when he has "
                    "left (420); the paper's method is almost unaffected.</i>") +
         Figure(RejectedOverFrames(drives.series),
                "Fig. 10. " + seed +
                    "Image corners (FAST) under what each system rejected. <i>As printed: the "
                    "paper's method fails in frames 241 to 263, when the pedestrian "
                    "turns, and 272 to 279, when he moves slowly; it extracts 1200 points a "
                    "frame.</i>") +
         "</div>\n";
}

std::string Tracks(const std::vector<SceneRuns>& scenes, const fs::path& report_dir) {
  std::string figures;
  for (const char* name : {"paper/scene2", "paper/scene3", "paper/scene4", "paper/scene5"}) {
    const SceneRuns* scene = LiveRunsOf(scenes, name);
    if (scene == nullptr) continue;
    const Drives drives(*scene, report_dir, kTrackStep);
    figures += Figure(TopViewChart(drives.series, TrackKind::kFinal),
                      fmt::format("{}, seed {}: final tracks from above, truth dashed.", name,
                                  scene->systems.front().runs.front()->spec.seed));
  }
  if (figures.empty()) return "";
  return "<h3>Fig. 11: trajectories of scenes 2 to 5</h3>\n<div class=\"charts\">" + figures +
         "</div>\n<p class=\"small soft\"><i>As printed: ORB-SLAM2 drifts badly when somebody "
         "passes in front of the camera, by up to 1.56, 3.85, 1.12 and 2.45 m in scenes 2 to 5; "
         "the paper's method by 0.31 m at most, like DynaSLAM.</i></p>\n";
}

}  // namespace

std::string PaperPage(const std::vector<SceneRuns>& scenes, const fs::path& report_dir) {
  const bool any = std::any_of(scenes.begin(), scenes.end(), [](const SceneRuns& scene) {
    return scene.twin == twin::kLive && scene.scene.starts_with("paper/scene");
  });
  if (!any) return "";
  const SceneRuns* first = LiveRunsOf(scenes, "paper/scene1");
  const std::string figures =
      (first == nullptr ? "" : SceneOne(*first, report_dir)) + Tracks(scenes, report_dir);
  return "<h2>The paper's experiment beside ours</h2>\n<p class=\"small soft\">In italics what "
         "the paper, " +
         Escape(kThePaper) +
         ", as printed, from its own hall, people and cameras (DynaSLAM under semantic). Only "
         "the order of the systems can be compared, not the size of the numbers; why they differ: "
         "reports/paper.md.</p>\n" +
         ToHtml(PaperTables(scenes)) + figures;
}

}  // namespace aisle
