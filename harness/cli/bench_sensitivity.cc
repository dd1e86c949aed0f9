#include <nlohmann/json.hpp>

#include "harness/bench/sensitivity.h"
#include "harness/cli/bench_source.h"
#include "harness/cli/command.h"
#include "harness/cli/common_options.h"
#include "harness/cli/early_checks.h"
#include "harness/cli/page_block.h"
#include "harness/cli/system_choice.h"
#include "harness/cli/terminal.h"
#include "harness/cli/typed_command.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/record/provenance.h"

namespace aisle {
namespace {

struct Options {
  std::vector<std::string> views;
  SensitivityOptions bench;
  SystemChoice system{.name = "robust", .set = {}};
  std::string views_file, json;
  PageBlock into{"sensitivity"};
};

using Json = nlohmann::ordered_json;

Json ToJson(const RejectionFigures& figures) {
  return {{"object_f1", figures.object_f1},
          {"pixel_iou", figures.pixel_iou},
          {"static_loss", figures.static_loss}};
}

Json ToJson(const std::optional<OptionVariant>& variant) {
  if (!variant) return nullptr;
  Json json = {{"value", variant->value}};
  json.update(ToJson(variant->figures));
  return json;
}

Json ToJson(const Sensitivity& sensitivity, const Provenance& own) {
  Json rows = Json::array();
  for (const OptionSensitivity& one : sensitivity.options) {
    rows.push_back({{"path", one.option.path},
                    {"value", one.option.value},
                    {"unit", one.option.unit},
                    {"effect", one.effect},
                    {"halved", ToJson(one.halved)},
                    {"doubled", ToJson(one.doubled)}});
  }
  return {{"version", own.version}, {"commit", own.commit},      {"cpu", own.cpu},
          {"threads", own.threads}, {"command", TypedCommand()}, {"base", ToJson(sensitivity.base)},
          {"options", rows}};
}

int BenchSensitivity(const Options& options) {
  std::vector<BenchView> views;  // all of them, before the first is read
  if (!options.views_file.empty()) views = ReadViews(options.views_file);
  for (const std::string& text : options.views) views.push_back(ParseView(text));
  if (views.empty()) throw InputError("no views: expected SCENE:FROM-TO, or --views FILE");
  options.into.Check();
  CheckCanBeWritten(options.json);
  ProgressLine line;
  const Sensitivity sensitivity =
      MeasureSensitivity(views, options.bench, [&](const std::string& at) { line.Show(at); });
  line.Clear();
  const std::string table = ToMarkdown(sensitivity);
  fmt::print("{}", table);
  options.into.Write(table);
  if (!options.json.empty()) {
    WriteFileAtomically(options.json, ToJson(sensitivity, OwnProvenance()).dump(2) + "\n");
  }
  return kAllPassed;
}

}  // namespace

void AddBenchSensitivity(CLI::App* bench, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = bench->add_subcommand("sensitivity",
                                            "Halve and double every option of a system, one at a "
                                            "time, and show how the objects found, the "
                                            "pixels rejected and the static pixels lost change");
  command->add_option(
      "VIEWS", options->views,
      "Scenes; :FROM-TO selects frames, @SEED sets the scene's seed; each is driven "
      "twice per option");
  command->add_option("--views", options->views_file,
                      "File with one view per line; scenes/stretches has some");
  AddSystemChoice(command, &options->system);
  command->add_option("--only", options->bench.prefix,
                      "Only vary options whose path begins with this; default: all");
  AddSourceOptions(command, &options->bench.source);
  command
      ->add_option("--warm-up", options->bench.warm_up,
                   "Frames to drive before FROM without counting them; default: 20")
      ->check(CLI::Range(0, 100000));
  command
      ->add_option("--jobs", options->bench.jobs,
                   "Drives to run at once, each on one thread; 0: as many as there are threads; "
                   "never changes a figure")
      ->check(CLI::Range(0, 1024));
  options->into.AddTo(command);
  AddJsonFile(command, &options->json, "every figure");
  command->footer(
      "Every value stays within its option's range.\n"
      "Example: ./aisle bench sensitivity paper/scene2:60-80@2 paper/scene5:420-440@5 --only "
      "dynamic.robust.field --frames-dir frames");
  command->callback([=] {
    *action = [=] {
      options->bench.system = SpecOf(options->system);
      return BenchSensitivity(*options);
    };
  });
}

}  // namespace aisle
