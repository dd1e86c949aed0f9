#include "harness/report/page/scene_charts.h"

#include <set>

#include "harness/record/frames_csv.h"
#include "harness/record/seed_values.h"
#include "harness/report/chart/charts.h"
#include "harness/report/chart/time_chart.h"
#include "harness/report/markup/html.h"
#include "harness/report/page/parts.h"
#include "harness/score/statistics.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

constexpr const char* kError = "ate_rmse_m";

/// The frames of every run of a system, and the lines that are drawn of them.
struct SystemFrames {
  std::vector<FrameFile> files;  ///< one per run
  std::size_t worst = 0;         ///< the run whose frames are shown; has some if any has
};

SystemFrames FramesOf(const SystemRuns& system, const fs::path& report_dir) {
  SystemFrames frames;
  double worst_m = -1;
  for (std::size_t i = 0; i < system.runs.size(); ++i) {
    frames.files.push_back(ReadFrameFile(*system.runs[i], report_dir));
    if (frames.files.back().rows.empty()) continue;
    const auto ate = system.runs[i]->scores.find(kError);
    const double error_m = ate != system.runs[i]->scores.end() ? ate->second.value.value_or(0) : 0;
    if (error_m <= worst_m) continue;
    worst_m = error_m;
    frames.worst = i;
  }
  return frames;
}

ChartSeries SeriesOf(const SystemRuns& system, const SystemFrames& frames) {
  ChartSeries series{
      .name = system.system, .color = system.color, .rows = &frames.files[frames.worst].rows};
  std::size_t known = 0;
  for (const FrameFile& file : frames.files) known += file.rows.empty() ? 0 : 1;
  if (known < 2) return series;
  series.seed = "worst: " + SeedOf(system.runs[frames.worst]->spec);
  for (const FrameFile& file : frames.files) {
    if (!file.rows.empty()) series.seeds.push_back(&file.rows);
  }
  return series;
}

/// The values of each input of a system that was driven over it several times.
std::map<std::uint64_t, std::vector<double>> RepeatsBySeed(const SystemRuns& system) {
  std::map<std::uint64_t, std::vector<double>> by_seed;
  for (const RunRecord* run : system.runs) {
    const auto score = run->scores.find(kError);
    if (score == run->scores.end() || !score->second.value) continue;
    by_seed[run->spec.seed].push_back(100 * *score->second.value);
  }
  return by_seed;
}

/// A row over the seeds, and one over the drives on the input on which they scatter most.
std::vector<SpreadRow> SpreadRows(const SystemRuns& system) {
  SpreadRow over_seeds{system.system, system.color, {}};
  SpreadRow on_one{"", system.color, {}};
  double widest = -1;
  for (const auto& [seed, values] : RepeatsBySeed(system)) {
    over_seeds.values.push_back(Quantile(values, 0.5));
    const double width = Quantile(values, 1) - Quantile(values, 0);
    if (values.size() < 2 || width <= widest) continue;
    widest = width;
    on_one.values = values;
    on_one.system = fmt::format("on seed {}", seed);
  }
  if (on_one.values.empty()) return {over_seeds};
  return {over_seeds, on_one};
}

std::string Spread(const SceneRuns& scene) {
  std::vector<SpreadRow> rows;
  for (const SystemRuns& system : scene.systems) {
    for (SpreadRow& row : SpreadRows(system)) rows.push_back(std::move(row));
  }
  const bool several =
      std::any_of(rows.begin(), rows.end(), [](const auto& row) { return row.values.size() > 1; });
  const bool repeated = std::any_of(rows.begin(), rows.end(), [](const SpreadRow& row) {
    return row.system.starts_with("on seed ");
  });
  if (!several) return "";
  return Figure(
      SpreadChart(rows, "ATE RMSE [cm]"),
      std::string("A mark per seed, the box holds the middle half, the median as a line.") +
          (repeated ? " Below a system that was driven several times over each input: "
                      "the drives over the one on which they scatter most."
                    : ""));
}

/// Times that are no stage of the system's own, or sums of such stages.
const std::set<std::string> kNoStages = {"process", "render", "total", "tracking", "front_end"};
/// Stages in threads of their own.
const std::set<std::string> kBeside = {"mapping", "global", "loop", "loop_closing"};

/// The stages of a run that make up its step or run beside it, by the scores that tell them.
std::set<std::string> StagesOf(const RunRecord& run) {
  std::set<std::string> stages;
  for (const auto& [name, score] : run.scores) {
    if (!name.starts_with("ms_") || !score.value) continue;
    const std::string stage = name.substr(3, name.size() - 3 - std::string("_mean").size());
    if (!kNoStages.contains(stage)) stages.insert(stage);
  }
  return stages;
}

/// A stage's mean over all frames, in the median of the seeds: it is told over those frames that
/// had it, and a run that never came to it spent nothing on it. Runs that tell no stage at all say
/// nothing.
double PerFrame(const std::vector<const RunRecord*>& runs, const std::string& stage) {
  const auto per_frame = [&](const RunRecord& run) -> std::optional<double> {
    if (run.frames == 0 || StagesOf(run).empty()) return std::nullopt;
    const auto at = run.scores.find("ms_" + stage + "_mean");
    if (at == run.scores.end() || !at->second.value) return 0;
    return *at->second.value * static_cast<double>(at->second.n) / static_cast<double>(run.frames);
  };
  const std::vector<double> values = MediansBySeed(runs, per_frame);
  return values.empty() ? 0 : Quantile(values, 0.5);
}

std::string Stages(const SceneRuns& scene) {
  std::map<std::string, int> colors;
  std::vector<StageRow> rows;
  for (const SystemRuns& system : scene.systems) {
    const std::vector<const RunRecord*> runs = CompleteOf(system.runs);
    const std::vector<double> steps_ms = ScoresOf(runs, "ms_process_mean");
    StageRow row{.system = system.system,
                 .step_ms = steps_ms.empty() ? 0 : Quantile(steps_ms, 0.5),
                 .inside = {},
                 .beside = {}};
    std::set<std::string> stages;
    for (const RunRecord* run : runs) stages.merge(StagesOf(*run));
    for (const std::string& stage : stages) {
      const int color = colors.emplace(stage, static_cast<int>(colors.size())).first->second;
      auto& bars = kBeside.contains(stage) ? row.beside : row.inside;
      bars.push_back({stage, color, PerFrame(runs, stage)});
    }
    if (row.step_ms > 0 || !row.inside.empty()) rows.push_back(row);
  }
  if (rows.empty()) return "";
  return Figure(StageChart(rows),
                "A step is as long as the harness saw it take, and made of the stages that the "
                "system tells; means over all frames, where a score ms_*_mean is of those that had "
                "the stage. The thin bar runs beside the frames, in "
                "threads of its own. Of a foreign system only the wall time is known.");
}

/// What cannot be drawn, and why: a whole system, or the first of its runs that lacks.
std::string Troubles(const SceneRuns& scene, const std::vector<SystemFrames>& frames) {
  std::string text;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::vector<FrameFile>& files = frames[i].files;
    const auto bad = std::ranges::find_if(files, [](const auto& f) { return !f.trouble.empty(); });
    if (bad == files.end()) continue;
    const SystemRuns& system = scene.systems[i];
    const bool drawn = !files[frames[i].worst].rows.empty();
    const RunSpec& spec = system.runs[static_cast<std::size_t>(bad - files.begin())]->spec;
    text += fmt::format("<p>{}{} is not in the charts: {}</p>\n", Escape(system.system),
                        drawn ? ", " + SeedOf(spec) + "," : "", Escape(bad->trouble));
  }
  return text;
}

}  // namespace

std::string SceneCharts(const SceneRuns& scene, const fs::path& report_dir) {
  std::vector<SystemFrames> frames;
  for (const SystemRuns& system : scene.systems) frames.push_back(FramesOf(system, report_dir));
  std::vector<ChartSeries> series;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].files[frames[i].worst].rows.empty()) continue;
    series.push_back(SeriesOf(scene.systems[i], frames[i]));
  }
  const bool several = std::any_of(series.begin(), series.end(),
                                   [](const ChartSeries& one) { return !one.seeds.empty(); });
  return Troubles(scene, frames) + "<div class=\"charts\">" +
         Figure(TimeChart(series),
                std::string("Distance of each live pose from truth after rigid alignment; gaps are "
                            "frames without a pose.") +
                    (several ? " Thick: the median over seeds, with the middle half of them as a "
                               "band; thin: the worst seed of each system."
                             : "") +
                    " Beneath, from truth: what moves in the left image, what each system rejected "
                    "of its corners, and how hard the frame is for anybody.") +
         "<div class=\"beside\">" +
         Figure(TopViewChart(series), std::string("Live tracks from above, truth dashed") +
                                          (several ? "; the worst seed of each system." : ".")) +
         Spread(scene) + Stages(scene) + "</div></div>\n";
}

}  // namespace aisle
