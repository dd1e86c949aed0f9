#include <algorithm>
#include <nlohmann/json.hpp>

#include "harness/cli/command.h"
#include "harness/cli/common_options.h"
#include "harness/cli/early_checks.h"
#include "harness/cli/page_block.h"
#include "harness/io/file.h"
#include "harness/io/places.h"
#include "harness/plugs/render_cost.h"
#include "harness/record/provenance.h"
#include "harness/suite/suite.h"

namespace aisle {
namespace {

struct RenderOptions {
  SimulatedSequenceOptions simulation;
  std::vector<std::string> scenes;
  int frames = 20;
  std::string json;
  PageBlock into{"cost"};
};

struct SceneCost {
  std::string scene;
  RenderCost cost;
};

double StageMs(const RenderCost& cost, const std::string& stage) {
  const auto found =
      std::ranges::find(cost.stage_ms, stage, &std::pair<std::string, double>::first);
  return found == cost.stage_ms.end() ? 0 : found->second;
}

/// A row a scene; stages as multiples of the bare primary rays, in the first scene's order.
std::string Table(const std::vector<SceneCost>& costs, const RenderOptions& options) {
  std::string head = "| scene | pair, ms | bare primary rays, ms | ratio | after a jump |";
  std::string rule = "|---|---|---|---|---|";
  for (const auto& [stage, ms] : costs.front().cost.stage_ms) {
    head += fmt::format(" {} |", stage);
    rule += "---|";
  }
  std::string rows;
  for (const SceneCost& one : costs) {
    rows += fmt::format("| {} | {:.0f} | {:.1f} | **{:.2f}** | {:.2f} |", one.scene,
                        one.cost.pair_ms, one.cost.bare_primary_ms, one.cost.ratio,
                        one.cost.after_jump_ms / one.cost.bare_primary_ms);
    for (const auto& [stage, ms] : costs.front().cost.stage_ms) {
      rows += fmt::format(" {:.2f} |", StageMs(one.cost, stage) / one.cost.bare_primary_ms);
    }
    rows += "\n";
  }
  return fmt::format("{}\n{}\n{}\nSeed {}, isa {}, {}, medians over {} frames per scene.\n", head,
                     rule, rows, options.simulation.seed, options.simulation.isa,
                     OwnProvenance().cpu, options.frames);
}

nlohmann::ordered_json ToJson(const SceneCost& one, const RenderOptions& options) {
  nlohmann::ordered_json json = {{"scene", one.scene},
                                 {"seed", options.simulation.seed},
                                 {"isa", options.simulation.isa},
                                 {"frames", one.cost.frames},
                                 {"pair_ms", one.cost.pair_ms},
                                 {"after_jump_ms", one.cost.after_jump_ms},
                                 {"bare_primary_ms", one.cost.bare_primary_ms},
                                 {"ratio", one.cost.ratio}};
  for (const auto& [stage, ms] : one.cost.stage_ms) json["stage_ms"][stage] = ms;
  return json;
}

void Print(const SceneCost& one, const RenderOptions& options) {
  const RenderCost& cost = one.cost;
  fmt::print("{}, isa {}, {}, median of {} frames\n", one.scene, options.simulation.isa,
             OwnProvenance().cpu, cost.frames);
  for (const auto& [stage, ms] : cost.stage_ms) {
    fmt::print("  {:<16}{:8.2f} ms{:7.2f} x\n", stage, ms, ms / cost.bare_primary_ms);
  }
  fmt::print("stereo pair with all truth   {:8.2f} ms\n", cost.pair_ms);
  fmt::print("bare primary rays            {:8.2f} ms\n", cost.bare_primary_ms);
  fmt::print("ratio                        {:8.2f}\n", cost.ratio);
  fmt::print("pair after a jump            {:8.2f} ms\n", cost.after_jump_ms);
  std::fflush(stdout);
}

int BenchRender(const RenderOptions& options) {
  options.into.Check();
  SimulatedSequenceOptions simulation = options.simulation;
  simulation.assets_dir = AssetsDir().string();
  std::vector<std::string> files;
  for (const std::string& scene : options.scenes) files.push_back(SceneFile(scene));
  CheckSceneFiles(files);
  CheckCanBeWritten(options.json);
  std::vector<SceneCost> costs;
  for (const std::string& file : files) {
    simulation.scene_file = file;
    simulation.scene_name = SceneName(file);
    costs.push_back({simulation.scene_name, MeasureRender(simulation, options.frames)});
    Print(costs.back(), options);
  }
  options.into.Write(Table(costs, options));
  if (options.json.empty()) return kAllPassed;
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const SceneCost& one : costs) json.push_back(ToJson(one, options));
  WriteFileAtomically(options.json, json.dump(2) + "\n");
  return kAllPassed;
}

}  // namespace

void AddBenchRender(CLI::App* bench, Action* action) {
  const auto options = std::make_shared<RenderOptions>();
  options->scenes = {"paper/scene3"};
  CLI::App* command = bench->add_subcommand(
      "render", "Time the rendering of stereo pairs, beside that of their primary rays alone");
  command->add_option("SCENES", options->scenes, "Scene files or names; default: paper/scene3");
  command
      ->add_option("--frames", options->frames,
                   "Frames to render per scene, evenly spread; default: 20")
      ->check(CLI::Range(2, 10000));
  AddSeed(command, &options->simulation.seed);
  AddTwin(command, &options->simulation.twin);
  AddIsa(command, &options->simulation.isa);
  AddThreads(command, &options->simulation.threads, "never changes a pixel");
  AddJsonFile(command, &options->json, "the medians, one object per scene,");
  options->into.AddTo(command);
  command->footer("Example: ./aisle bench render paper/scene2 paper/scene3 --frames 10");
  command->callback([=] { *action = [=] { return BenchRender(*options); }; });
}

}  // namespace aisle
