// Forges a bad month: thirty nights of one suite in DIR/2026-01-01 and so on, with their history,
// in which one scene drifts from night 12 on, a foreign system crashes on another from night 20 on,
// and one system becomes slower at night 25. Who reads the last night's report should find out what
// got worse, since when, why, and see it, in three clicks each: write_month DIR.
#include "harness/judge/limit.h"
#include "harness/report/report.h"
#include "tests/harness/record/night.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

constexpr int kNights = 30, kDrifts = 12, kCrashes = 20, kSlower = 25;  // nights, from 1 on
constexpr int kShown = 2;  ///< last nights that kept frames: others would only take time
constexpr std::size_t kFrames = 160, kScenes = 3;
constexpr std::uint64_t kSeeds = 3;

std::string DateOf(int night) { return fmt::format("2026-01-{:02}", night); }

/// The scatter of one night, the same whenever it is forged: within 2 %.
double Scatter(int night, std::uint64_t seed) {
  return 1 + 0.01 * static_cast<double>((static_cast<std::uint64_t>(night) * 31 + seed * 17) % 5) -
         0.02;
}

double PushOf(const std::string& system, std::size_t scene, int night, std::uint64_t seed) {
  const double base_m = system == "oracle" ? 0.05 : system == "mine" ? 0.4 : 0.25;
  const bool drifts = scene == 2 && system == "robust" && night >= kDrifts;
  return base_m * (1 + 0.1 * static_cast<double>(seed)) * Scatter(night, seed) *
         (drifts ? 1.5 + 0.1 * (night - kDrifts) : 1);
}

RunResult DriveOf(const std::string& system, std::size_t scene, int night, std::uint64_t seed) {
  RunResult run = MakeRun(fmt::format("paper/scene{}", scene), system, seed,
                          PushOf(system, scene, night, seed), kFrames);
  const bool slower = system == "robust" && night >= kSlower;
  for (FrameFacts& facts : run.facts) facts.process_ms = slower ? 61 : 35;
  if (system != "mine") return run;
  run.spec.system = {.name = "mine", .external = ExternalSystem{.command = "my_slam {output}"}};
  run.system_version = fmt::format("v1.{}", night / 4);
  run.wall_s = 6;
  if (scene != 3 || night < kCrashes) return run;
  run.trajectory = {};
  for (FrameEstimate& estimate : run.estimates) estimate.T_world_rig.reset();
  run.status = RunStatus::kCrashed;
  run.status_why = "exit code 134: signal 6, SIGABRT (Aborted), as reported by the shell";
  run.last_words =
      "map.cc:42: Assertion `points > 0' failed.\n<script>alert(1)</script>\nAborted\n";
  return run;
}

Results NightOf(int night, const fs::path& folder) {
  Results results;
  results.provenance = {"0.2.0", fmt::format("c{:06}", night * 7919), "some processor", "Debian",
                        2};
  results.suite = "nightly";
  results.question = "What got worse since yesterday?";
  results.started = DateOf(night) + "T02:00:00Z";
  results.rerun = "./aisle run scenes/suites/nightly.yaml --out " + folder.string();
  results.wall_s = 5000;
  for (std::size_t scene = 1; scene <= kScenes; ++scene) {
    for (const char* system : {"plain", "robust", "oracle", "mine"}) {
      for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
        const RunResult run = DriveOf(system, scene, night, seed);
        const RunScore score = ScoreRun(run);
        RunRecord record = MakeRecord(run, score, 20);
        const bool shown = run.status == RunStatus::kOk && night > kNights - kShown;
        if (shown) AddPictures(folder, &record);
        results.runs.push_back(WriteRun(run, score, record, folder));
      }
    }
  }
  results.verdicts = Judge(results.runs, {{.score = "ate_rmse_m",
                                           .scene = "",
                                           .twin = "live",
                                           .system = "robust",
                                           .min = {},
                                           .max = 0.015}});
  return results;
}

void WriteMonth(const fs::path& folder) {
  const fs::path history = folder / "history.sqlite";
  for (int night = 1; night <= kNights; ++night) {
    const fs::path out = folder / DateOf(night);
    const Results results = NightOf(night, out);
    AppendToHistory(history, results, out);
    WriteReport(results, out,
                {.history = ReadHistory(history, results.suite), .history_file = history});
  }
}

}  // namespace
}  // namespace aisle

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: write_month DIR\n");
    return 4;
  }
  aisle::WriteMonth(argv[1]);
  return 0;
}
