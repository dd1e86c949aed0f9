#include <nlohmann/json.hpp>

#include "harness/bench/accuracy.h"
#include "harness/cli/bench_source.h"
#include "harness/cli/command.h"
#include "harness/cli/common_options.h"
#include "harness/cli/early_checks.h"
#include "harness/cli/system_choice.h"
#include "harness/cli/terminal.h"
#include "harness/io/file.h"
#include "harness/score/statistics.h"

namespace aisle {
namespace {

struct Options {
  std::vector<std::string> views;
  AccuracyBenchOptions bench;
  SystemChoice system{.name = "plain", .set = {}};
  std::string json;
};

std::string Cell(const std::vector<double>& values, double unit) {
  if (values.empty()) return fmt::format("{:>24}", "-");
  const Statistics over = Summarize(values);
  return fmt::format("{:>24}", fmt::format("{:.2f} ({:.2f} to {:.2f})", over.median / unit,
                                           over.min / unit, over.max / unit));
}

int BenchAccuracy(const Options& options) {
  const AccuracyBenchOptions& bench = options.bench;
  CheckCanBeWritten(options.json);
  std::vector<BenchView> views;
  for (const std::string& text : options.views) {  // all, before the first drives
    views.push_back(ParseView(text));
    CheckStarts(views.back(), views.back().to, bench);
  }
  fmt::print("{}, {} starts, {} frames apart: median (minimum to maximum)\n", bench.system.name,
             bench.starts, bench.step);
  fmt::print("{:28}{:>7}{:>24}{:>24}{:>24}\n", "view", "frames", "live ATE cm", "final ATE cm",
             "frames lost");
  nlohmann::json rows = nlohmann::json::array();
  for (const BenchView& view : views) {
    ProgressLine line;
    const AccuracyOfView outcome =
        MeasureAccuracy(view, bench, [&](const std::string& at) { line.Show(at); });
    line.Clear();
    fmt::print("{:28}{:7}{}{}{}\n", Abridged(view.text, 27), outcome.frames,
               Cell(outcome.live_m, 0.01), Cell(outcome.final_m, 0.01),
               Cell(outcome.frames_lost, 1));
    std::fflush(stdout);
    rows.push_back({{"view", view.text},
                    {"frames", outcome.frames},
                    {"ate_live_rmse_m", outcome.live_m},
                    {"ate_rmse_m", outcome.final_m},
                    {"frames_lost", outcome.frames_lost}});
  }
  if (!options.json.empty()) WriteFileAtomically(options.json, rows.dump(2) + "\n");
  return kAllPassed;
}

}  // namespace

void AddBenchAccuracy(CLI::App* bench, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = bench->add_subcommand("accuracy",
                                            "Measure the trajectory error on the same pictures "
                                            "from several first frames, to see how much "
                                            "of a difference between two versions is luck");
  command
      ->add_option("VIEWS", options->views,
                   "Scenes or recordings' folders; :FROM-TO selects frames")
      ->required();
  AddSourceOptions(command, &options->bench.source);
  AddSystemChoice(command, &options->system);
  command->add_option("--starts", options->bench.starts, "Drives per view; default: 9")
      ->check(CLI::Range(1, 1000));
  command->add_option("--step", options->bench.step, "Frames between two starts; default: 1")
      ->check(CLI::Range(1, 1000));
  AddJsonFile(command, &options->json, "every value");
  command->footer(
      "Example: ./aisle bench accuracy paper/scene2 weakness/plain_coat --frames-dir frames");
  command->callback([=] {
    *action = [=] {
      options->bench.system = SpecOf(options->system);
      return BenchAccuracy(*options);
    };
  });
}

}  // namespace aisle
