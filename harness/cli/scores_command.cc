// What a run can be judged by, with units: the names that limits and reports take.
#include "harness/cli/command.h"
#include "harness/cli/common_options.h"
#include "harness/record/record_json.h"
#include "harness/score/score_names.h"

namespace aisle {
namespace {

struct Options {
  std::string filter;
  bool json = false;
};

int PrintScores(const Options& options) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const ScoreDescription& score : ScoreNames()) {
    if (score.name.find(options.filter) == std::string::npos) continue;
    list.push_back({{"name", score.name}, {"unit", score.unit}, {"help", score.help}});
    if (options.json) continue;
    fmt::print("{:36} {:9} {}\n", score.name, score.unit == "1" ? "" : score.unit, score.help);
  }
  if (options.json) fmt::print("{}", Dump({{"scores", list}}));
  if (!list.empty()) return kAllPassed;
  fmt::print(stderr, "aisle: no score has '{}' in its name\n", options.filter);
  return kNothingToDo;
}

}  // namespace

void AddScoresCommand(CLI::App* app, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      app->add_subcommand("scores", "List every score of a run with its unit and meaning");
  command->add_option("FILTER", options->filter, "Only list scores with this text in their name");
  AddJson(command, &options->json);
  command->footer(
      "A * stands for a stage, a class or a time that differs from run to run.\n"
      "Example: ./aisle scores object_");
  command->callback([=] { *action = [=] { return PrintScores(*options); }; });
}

}  // namespace aisle
