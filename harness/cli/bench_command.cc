#include <nlohmann/json.hpp>

#include "harness/cli/by_name.h"
#include "harness/cli/command.h"
#include "harness/io/file.h"
#include "harness/io/places.h"
#include "harness/plugs/render_cost.h"
#include "harness/record/provenance.h"
#include "harness/suite/suite.h"

namespace aisle {
namespace {

struct RenderOptions {
  SimulatedSequenceOptions simulation;
  int frames = 20;
  std::string json;
};

void WriteJson(const RenderCost& cost, const RenderOptions& options) {
  nlohmann::ordered_json json = {{"scene", options.simulation.scene_name},
                                 {"seed", options.simulation.seed},
                                 {"isa", options.simulation.isa},
                                 {"frames", cost.frames},
                                 {"pair_ms", cost.pair_ms},
                                 {"bare_primary_ms", cost.bare_primary_ms},
                                 {"ratio", cost.ratio}};
  for (const auto& [stage, ms] : cost.stage_ms) json["stage_ms"][stage] = ms;
  WriteFileAtomically(options.json, json.dump(2) + "\n");
}

int BenchRender(RenderOptions options) {
  if (options.simulation.scene_file.empty()) {
    const std::filesystem::path tree = AssetsDir().parent_path();
    options.simulation.scene_file = (tree / "scenes/paper/scene3.yaml").string();
  }
  options.simulation.assets_dir = AssetsDir().string();
  options.simulation.scene_name = SceneName(options.simulation.scene_file);
  const RenderCost cost = MeasureRender(options.simulation, options.frames);

  const Provenance own = OwnProvenance();
  fmt::print("{}, isa {}, {}, median of {} frames\n", options.simulation.scene_name,
             options.simulation.isa, own.cpu, cost.frames);
  for (const auto& [stage, ms] : cost.stage_ms) {
    fmt::print("  {:<16}{:8.2f} ms{:7.2f} x\n", stage, ms, ms / cost.bare_primary_ms);
  }
  fmt::print("stereo pair with all truth   {:8.2f} ms\n", cost.pair_ms);
  fmt::print("bare primary rays            {:8.2f} ms\n", cost.bare_primary_ms);
  fmt::print("ratio                        {:8.2f}\n", cost.ratio);
  if (!options.json.empty()) WriteJson(cost, options);
  return kAllPassed;
}

void AddBenchRender(CLI::App* bench, Action* action) {
  const auto options = std::make_shared<RenderOptions>();
  CLI::App* command =
      bench->add_subcommand("render", "milliseconds a stereo pair, beside its bare primary rays");
  command
      ->add_option("SCENE", options->simulation.scene_file,
                   "scene file (default: scenes/paper/scene3.yaml)")
      ->transform(ByName());
  command->add_option("--frames", options->frames, "frames spread over the scene (default 20)")
      ->check(CLI::Range(2, 10000));
  command->add_option("--seed", options->simulation.seed, "of the scene; default 1");
  command->add_option("--isa", options->simulation.isa,
                      "instruction set of the tracer; avx2 (default) or native");
  command->add_option("--threads", options->simulation.threads, "0: all");
  command->add_option("--json", options->json, "write the medians there too");
  command->callback([=] { *action = [=] { return BenchRender(*options); }; });
}

}  // namespace

void AddBenchCommand(CLI::App* app, Action* action) {
  CLI::App* bench = app->add_subcommand("bench", "what things cost on this machine");
  bench->require_subcommand(1);
  bench->footer("Example: ./aisle bench render --frames 20");
  AddBenchRender(bench, action);
  AddBenchLight(bench, action);
  AddBenchSlam(bench, action);
  AddBenchAccuracy(bench, action);
  AddBenchDynamic(bench, action);
  AddBenchRealism(bench, action);
  AddBenchSensitivity(bench, action);
  AddBenchSearch(bench, action);
}

}  // namespace aisle
