#include "harness/bench/growth.h"

#include <unistd.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>
#include <stdexcept>

#include "harness/io/file.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

constexpr double kUsualWidth = 752, kUsualFocal = 435.2;  // pixels

/// Somebody who goes to and fro between two places.
struct Worker {
  const char* model;
  double x, y, far_x, far_y;
  bool is_vehicle = false;
};

// Near and far by turns, so that the first few are no other mixture than all.
constexpr std::array<Worker, kMostGrowthActors> kWorkers = {{
    {"worker_anton", 5.2, -0.9, 6.4, -1.1},
    {"picker_carl", 7.4, 0.8, 6.0, 1.1},
    {"forklift_driver", 12.6, 0.2, 10.6, 0.2, true},
    {"fitter_gus", 4.0, 1.3, 5.0, 0.9},
    {"worker_bea", 9.0, -1.2, 8.0, -0.6},
    {"worker_anton", 10.0, 1.4, 9.0, 1.0},
    {"fitter_gus", 6.6, -1.7, 7.6, -1.5},
    {"forklift", 15.4, -1.4, 14.0, -1.4, true},
    {"picker_carl", 3.6, -1.5, 4.4, -1.8},
    {"worker_bea", 8.2, 1.8, 7.2, 1.6},
    {"worker_anton", 11.2, -1.6, 10.2, -1.4},
    {"picker_carl", 13.6, 1.6, 12.6, 1.7},
}};

std::string HallText(int rack_levels) {
  std::string text = "hall: {from: [-5, -8], to: [24, 8], height_m: 6.5, wear: 0.6}\n";
  if (rack_levels > 0) {
    text += "racks:\n";
    for (const double y : {2.8, -2.8, 6.3, -6.3}) {
      text += fmt::format("  - {{from: [-3.2, {}], bays: 8, levels: {}, goods: mixed}}\n", y,
                          rack_levels);
    }
  }
  return text + "lights:\n  - {rows: 3, per_row: 6, height_m: 5.9, brightness: 1.5}\n";
}

std::string WorkerText(std::size_t index, const Worker& worker) {
  const double heading_deg =
      std::atan2(worker.far_y - worker.y, worker.far_x - worker.x) * 180 / std::numbers::pi;
  return fmt::format(
      "  - name: actor_{}\n    model: {}\n    start: [{}, {}]\n    heading_deg: {:.1f}\n"
      "    start_s: 0\n    steps:\n      - {{go: [[{}, {}]], speed_mps: 0.8}}\n",
      index + 1, worker.model, worker.x, worker.y, heading_deg, worker.far_x, worker.far_y);
}

/// A folder of scene files that goes with its owner.
class ScratchFolder {
 public:
  ScratchFolder() : path_(fs::temp_directory_path() / fmt::format("aisle_growth_{}", ::getpid())) {
    fs::create_directories(path_);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  fs::path Write(const std::string& text) const {
    const fs::path file = path_ / "growth.yaml";
    WriteFileAtomically(file, text);
    return file;
  }

 private:
  fs::path path_;
};

/// Of one scene, by number of threads.
std::vector<ThreadTime> TimesOf(const std::vector<GrowthRow>& rows, const GrowthScene& scene) {
  std::vector<ThreadTime> times;
  for (const GrowthRow& row : rows) {
    if (row.scene == scene) times.push_back({row.threads, row.cost.pair_ms});
  }
  std::ranges::sort(times, {}, &ThreadTime::threads);
  return times;
}

std::string MeasuredRow(const GrowthRow& one, const ThreadTime& many) {
  const double times_as_fast = one.cost.pair_ms / many.ms;
  return fmt::format("| {} | {} | {:.0f} | {:.0f} | {:.2f} | {:.2f} |\n", one.scene.actors,
                     many.threads, one.cost.pair_ms, many.ms, times_as_fast,
                     times_as_fast / many.threads);
}

constexpr std::array<int, 3> kForecastThreads = {4, 8, 16};

std::string FittedHead() {
  std::string head, rule;
  for (const int threads : kForecastThreads) {
    head += fmt::format(" times as fast on {} |", threads);
    rule += "---:|";
  }
  return fmt::format("| actors | serial share, fitted | residual, % |{}\n|---:|---:|---:|{}\n",
                     head, rule);
}

std::string FittedRow(int actors, const ScalingFit& fit) {
  const bool tells = fit.serial_share > 0;
  std::string row =
      fmt::format("| {} | {} | {:.1f} |", actors,
                  tells ? fmt::format("{:.3f}", fit.serial_share) : "-", 100 * fit.residual);
  for (const int threads : kForecastThreads) {
    row += tells ? fmt::format(" {:.1f} |", SpeedUp(fit.serial_share, threads)) : " - |";
  }
  row += "\n";
  return row;
}

}  // namespace

std::string GrowthSceneText(const GrowthScene& scene) {
  if (scene.actors < 0 || scene.actors > kMostGrowthActors) {
    throw std::invalid_argument(
        fmt::format("{} actors; there are 0 to {}", scene.actors, kMostGrowthActors));
  }
  const double focal = kUsualFocal * scene.width / kUsualWidth;
  std::string text = fmt::format(
      "about: Actors at work before the camera, for what rendering them costs.\n"
      "frames: {0}\nrate_hz: 20\n"
      "camera: {{size_px: [{1}, {2}], focal_px: [{3}, {3}], center_px: [{4}, {5}]}}\n"
      "rig:\n  camera_height_m: 0.85\n  camera_pitch_deg: -3\n  start: [0, 0]\n"
      "  steps:\n    - {{go: [[2, 0]], speed_mps: 0.8}}\n",
      scene.frames, scene.width, scene.height, focal, (scene.width - 1) / 2.0,
      (scene.height - 1) / 2.0);
  text += HallText(scene.rack_levels);
  for (const bool vehicles : {false, true}) {
    std::string list;
    for (std::size_t i = 0; i < static_cast<std::size_t>(scene.actors); ++i) {
      if (kWorkers[i].is_vehicle == vehicles) list += WorkerText(i, kWorkers[i]);
    }
    if (!list.empty()) text += (vehicles ? "vehicles:\n" : "people:\n") + list;
  }
  return text;
}

std::vector<GrowthSeries> GrowthPlan(const GrowthOptions& options) {
  const GrowthScene usual{.frames = options.frames + 1};
  std::vector<GrowthSeries> plan = {{usual, options.threads, {0, 1, 3, 6, 12}}};
  const auto add = [&](int threads, const auto& change) {
    GrowthSeries series{usual, threads, {0, 3, 12}};
    change(&series.scene);
    plan.push_back(series);
  };
  for (const int levels : {0, 1}) {
    add(options.threads, [&](GrowthScene* scene) { scene->rack_levels = levels; });
  }
  for (const auto& [width, height] : {std::pair(1280, 720), {1241, 376}}) {
    add(options.threads, [&](GrowthScene* scene) { scene->width = width, scene->height = height; });
  }
  for (int threads = 1; threads < options.threads; threads *= 2) add(threads, [](GrowthScene*) {});
  return plan;
}

std::vector<GrowthRow> MeasureGrowth(const GrowthOptions& options,
                                     const std::function<void(const GrowthRow&)>& measured) {
  const ScratchFolder folder;
  std::vector<GrowthRow> rows;
  for (const GrowthSeries& series : GrowthPlan(options)) {
    double none_ms = 0;
    for (const int actors : series.actors) {
      GrowthRow row{.scene = series.scene, .threads = series.threads, .cost = {}};
      row.scene.actors = actors;
      row.cost = MeasureRender({.scene_file = folder.Write(GrowthSceneText(row.scene)).string(),
                                .scene_name = "growth",
                                .assets_dir = options.assets_dir,
                                .threads = row.threads,
                                .isa = options.isa,
                                .light_spacing = options.light_spacing},
                               row.scene.frames);
      if (actors == 0) none_ms = row.cost.pair_ms;
      row.of_none = row.cost.pair_ms / none_ms;
      rows.push_back(row);
      if (measured) measured(row);
    }
  }
  return rows;
}

std::string GrowthTable(const std::vector<GrowthRow>& rows) {
  std::string table =
      "| actors | triangles, of them moving | picture | threads | pair, ms | bare primary rays, ms "
      "| ratio | of the pair with none |\n|---|---|---|---|---|---|---|---|\n";
  for (const GrowthRow& row : rows) {
    table += fmt::format(
        "| {} | {} k, {} k | {} x {} | {} | {:.0f} | {:.1f} | **{:.2f}** | {:.2f} |\n",
        row.scene.actors, (row.cost.triangles + 500) / 1000,
        (row.cost.moving_triangles + 500) / 1000, row.scene.width, row.scene.height, row.threads,
        row.cost.pair_ms, row.cost.bare_primary_ms, row.cost.ratio, row.of_none);
  }
  return table;
}

std::optional<ScalingFit> FitScaling(const std::vector<ThreadTime>& times) {
  constexpr std::size_t kParameters = 2;
  std::set<int> counts;
  for (const ThreadTime& time : times) counts.insert(time.threads);
  if (counts.size() <= kParameters) return std::nullopt;
  // ms = serial + parallel / threads, each equation over its ms: slow runs are noisier by as much.
  const auto rows = static_cast<Eigen::Index>(times.size());
  Eigen::MatrixX2d a(rows, 2);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const ThreadTime& time = times[static_cast<std::size_t>(i)];
    a.row(i) << 1 / time.ms, 1 / (time.threads * time.ms);
  }
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(rows);
  const Eigen::Vector2d law = a.colPivHouseholderQr().solve(one);
  const double freedom = static_cast<double>(times.size() - kParameters);
  return ScalingFit{.serial_share = law[0] / law.sum(),
                    .residual = (a * law - one).norm() / std::sqrt(freedom)};
}

double SpeedUp(double serial_share, int threads) {
  return 1 / (serial_share + (1 - serial_share) / threads);
}

std::string ScalingTable(const std::vector<GrowthRow>& rows) {
  std::string measured, fitted;
  for (const GrowthRow& one : rows) {
    if (one.threads != 1) continue;
    const std::vector<ThreadTime> times = TimesOf(rows, one.scene);
    for (const ThreadTime& time : times) {
      if (time.threads > 1) measured += MeasuredRow(one, time);
    }
    if (const auto fit = FitScaling(times)) fitted += FittedRow(one.scene.actors, *fit);
  }
  if (measured.empty()) return "";
  if (!fitted.empty()) fitted = fmt::format("\n{}{}", FittedHead(), fitted);
  return fmt::format(
      "| actors | threads | pair on one thread, ms | on all, ms | times as fast | efficiency |\n"
      "|---:|---:|---:|---:|---:|---:|\n{}{}",
      measured, fitted);
}

}  // namespace aisle
