#include "harness/bench/growth.h"
#include "harness/cli/command.h"
#include "harness/cli/common_options.h"
#include "harness/cli/page_block.h"
#include "harness/io/places.h"
#include "harness/record/provenance.h"

namespace aisle {
namespace {

struct Options {
  GrowthOptions bench;
  PageBlock into{"growth"};
};

int BenchGrowth(const Options& options) {
  options.into.Check();
  GrowthOptions bench = options.bench;
  bench.assets_dir = AssetsDir().string();
  fmt::print("{:>7}{:>12}{:>12}{:>9}{:>10}{:>9}{:>8}{:>10}\n", "actors", "triangles", "picture",
             "threads", "pair ms", "bare ms", "ratio", "of none");
  const std::vector<GrowthRow> rows = MeasureGrowth(bench, [](const GrowthRow& row) {
    fmt::print("{:7}{:12}{:>12}{:9}{:10.1f}{:9.1f}{:8.2f}{:10.2f}\n", row.scene.actors,
               row.cost.triangles, fmt::format("{}x{}", row.scene.width, row.scene.height),
               row.threads, row.cost.pair_ms, row.cost.bare_primary_ms, row.cost.ratio,
               row.of_none);
    std::fflush(stdout);
  });
  const std::string scaling = ScalingTable(rows);
  if (!scaling.empty()) fmt::print("\nSpeed-up over one thread:\n{}", scaling);
  options.into.Write(fmt::format("{}{}{}\nIsa {}, {}, medians of {} frames, one after the other.\n",
                                 GrowthTable(rows), scaling.empty() ? "" : "\n", scaling, bench.isa,
                                 OwnProvenance().cpu, bench.frames));
  return kAllPassed;
}

}  // namespace

void AddBenchGrowth(CLI::App* bench, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = bench->add_subcommand(
      "growth",
      "Measure how the cost of a stereo pair grows with actors, triangles, pixels and threads");
  command->add_option("--frames", options->bench.frames, "Frames to render per row; default: 8")
      ->check(CLI::Range(1, 1000));
  command
      ->add_option("--threads", options->bench.threads,
                   "Number of threads, for all rows but those that compare fewer; default: 2")
      ->check(CLI::Range(1, 1024));
  AddIsa(command, &options->bench.isa);
  options->into.AddTo(command);
  command->footer("Example: ./aisle bench growth --frames 4");
  command->callback([=] { *action = [=] { return BenchGrowth(*options); }; });
}

}  // namespace aisle
