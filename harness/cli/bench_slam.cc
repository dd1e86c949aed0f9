#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "harness/bench/stages.h"
#include "harness/cli/bench_source.h"
#include "harness/cli/command.h"
#include "harness/cli/common_options.h"
#include "harness/cli/early_checks.h"
#include "harness/cli/system_choice.h"
#include "harness/cli/terminal.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/score/front_end.h"

namespace aisle {
namespace {

struct Options {
  std::string source = "paper/scene1", json;
  bool latency_profile = false;
  StageBenchOptions bench;
  SystemChoice system{.name = "plain", .set = {}};
};

void PrintLap(const BenchLap& lap) {
  if (lap.index == 0) {
    fmt::print("{:>4} {:>10} {:>10} {:>10} {:>6}\n", "lap", "keyframes", "landmarks", "MiB",
               "lost");
  }
  const auto count = [&](const char* name) {
    const auto found = lap.last.counts.find(name);
    return found == lap.last.counts.end() ? 0 : found->second;
  };
  fmt::print("{:4} {:10} {:10} {:10.1f} {:6}\n", lap.index + 1, count("map_keyframes"),
             count("map_landmarks"), lap.resident_mib, lap.lost);
  std::fflush(stdout);  // hours may pass between two lines
}

std::map<std::string, StageTime> Measure(const Options& options) {
  ProgressLine line;
  const BenchView view = ParseView(options.source);
  std::map<std::string, StageTime> stages = MeasureStages(
      view, options.bench, [&](const std::string& at) { line.Show(at); },
      [&](const BenchLap& lap) {
        line.Clear();
        if (options.bench.laps > 1) PrintLap(lap);
      });
  RefuseEmptyView(view, stages["frame"].ms.size());
  return stages;
}

/// Means over the frames that had the stage, and how many these are.
nlohmann::json ToJson(std::map<std::string, StageTime> stages, double front_end_ms) {
  nlohmann::json json = {{"dynamic_ms_p99", stages["dynamic"].quantile_ms(0.99)},
                         {"front_end_ms", front_end_ms},
                         {"frame_ms_p99", stages["frame"].quantile_ms(0.99)},
                         {"frames", stages["frame"].ms.size()}};
  for (const auto& [key, stage] :
       {std::pair("extract", "extract"), std::pair("stereo", "stereo"), std::pair("track", "track"),
        std::pair("map", "mapping"), std::pair("dynamic", "dynamic")}) {
    json[std::string(key) + "_ms"] = stages[stage].mean_ms();
    json["frames_with"][key] = stages[stage].ms.size();
  }
  const double reference_ms = stages["reference"].mean_ms();
  if (reference_ms > 0) {  // measured over a single lap alone
    json["reference_orb_ms"] = reference_ms;
    json["ratio"] = front_end_ms / reference_ms;
  }
  return json;
}

int BenchSlam(const Options& options) {
  CheckCanBeWritten(options.json);
  std::map<std::string, StageTime> stages = Measure(options);
  std::map<std::string, double> mean_ms;
  for (const auto& [stage, time] : stages) mean_ms[stage] = time.mean_ms();
  const double front_end_ms = FrontEndOf(mean_ms).value_or(FrontEndMs{}).total();
  const double reference_ms = stages["reference"].mean_ms();
  fmt::print("{:18} {:>9} {:>9} {:>9} {:>7}\n", "stage", "mean ms", "99 % ms", "worst ms",
             "frames");
  for (const auto& [stage, time] : stages) {
    fmt::print("{:18} {:9.2f} {:9.2f} {:9.2f} {:7}\n", stage, time.mean_ms(),
               time.quantile_ms(0.99), time.quantile_ms(1), time.ms.size());
  }
  fmt::print("front end: {:.2f} ms per frame", front_end_ms);
  if (reference_ms > 0) {
    fmt::print(", {:.2f} times OpenCV's ORB on both cameras", front_end_ms / reference_ms);
  }
  fmt::print("\n");
  if (options.latency_profile) {
    fmt::print("options: {{drive.latency_profile_ms: \"{:.1f}\"}}\n",
               fmt::join(LatencyProfile(stages["frame"]), ","));
  }
  if (!options.json.empty()) {
    WriteFileAtomically(options.json, ToJson(stages, front_end_ms).dump(2) + "\n");
  }
  return kAllPassed;
}

}  // namespace

void AddBenchSlam(CLI::App* bench, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* slam =
      bench->add_subcommand("slam", "Time the SLAM's stages, in milliseconds per frame");
  slam->add_option("SOURCE", options->source,
                   "Scene or a recording's folder; :FROM-TO selects frames; default: paper/scene1");
  AddSourceOptions(slam, &options->bench.source);
  AddSystemChoice(slam, &options->system);
  slam->add_option("--frames", options->bench.frames, "Most frames to drive; default: 100")
      ->check(CLI::Range(1, 100000));
  slam->add_option("--laps", options->bench.laps,
                   "Drive the frames N times, one lap after the other, and print what each lap "
                   "leaves in memory; for a source that ends where it begins")
      ->check(CLI::Range(1, 100000));
  AddJsonFile(slam, &options->json,
              "the means, over the frames that had the stage, which frames_with counts,");
  slam->add_flag(
      "--latency-profile", options->latency_profile,
      "Print the time per frame as an option of closed-loop drives, for a suite's system");
  slam->footer(
      "Example: ./aisle bench slam --json slam.json\n"
      "         ./aisle bench slam drive/aisle_dock --system robust --latency-profile\n"
      "         ./aisle bench slam paper/scene4 --laps 20 --frames 900 --frames-dir f");
  slam->callback([=] {
    *action = [=] {
      options->bench.system = SpecOf(options->system);
      return BenchSlam(*options);
    };
  });
}

}  // namespace aisle
