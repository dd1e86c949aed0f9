// What can be put under test, with every option.
#include <nlohmann/json.hpp>

#include "harness/cli/command.h"
#include "harness/cli/common_options.h"
#include "harness/plugs/systems.h"
#include "harness/record/record_json.h"

namespace aisle {
namespace {

struct Options {
  std::string system, filter;
  bool json = false;
};

using Json = nlohmann::ordered_json;

std::string WordOf(SystemOption::Kind kind) {
  switch (kind) {
    case SystemOption::Kind::kNumber:
      return "number";
    case SystemOption::Kind::kInteger:
      return "integer";
    case SystemOption::Kind::kFlag:
      return "flag";
    case SystemOption::Kind::kChoice:
      return "choice";
    case SystemOption::Kind::kText:
      break;
  }
  return "text";
}

/// What may stand there: "0 to 1", "none, paper, robust", "true or false".
std::string AllowedOf(const SystemOption& option) {
  switch (option.kind) {
    case SystemOption::Kind::kNumber:
    case SystemOption::Kind::kInteger:
      return fmt::format("{:g} to {:g}", option.low, option.high);
    case SystemOption::Kind::kFlag:
      return "true or false";
    case SystemOption::Kind::kChoice:
      return fmt::format("{}", fmt::join(option.choices, ", "));
    case SystemOption::Kind::kText:
      break;
  }
  return "text";
}

Json ToJson(const SystemOption& option) {
  Json json = {{"path", option.path},
               {"kind", WordOf(option.kind)},
               {"value", option.value},
               {"unit", option.unit},
               {"help", option.help}};
  if (option.kind == SystemOption::Kind::kNumber || option.kind == SystemOption::Kind::kInteger) {
    json["low"] = option.low;
    json["high"] = option.high;
  }
  if (!option.choices.empty()) json["choices"] = option.choices;
  return json;
}

std::vector<SystemOption> Chosen(const System& system, const std::string& filter) {
  std::vector<SystemOption> options = OptionsOf(system);
  std::erase_if(options, [&](const SystemOption& option) {
    return option.path.find(filter) == std::string::npos;
  });
  return options;
}

int PrintSystems(bool json) {
  Json list = Json::array();
  for (const System& system : Systems()) {
    list.push_back({{"name", system.name}, {"description", system.description}});
    if (!json) fmt::print("{:10} {}\n", system.name, system.description);
  }
  if (json) {
    fmt::print("{}", Dump({{"systems", list}}));
  } else {
    fmt::print(
        "\n`aisle systems NAME [FILTER]` lists the options of a system. To set one in a suite "
        "file:\n  systems: [robust, {{name: robust_800, like: robust, options: {{feature.features: "
        "800}}}}]\nFor a trial: `aisle run … --set robust.feature.features=800`.\n");
  }
  return kAllPassed;
}

int PrintOptions(const Options& options) {
  const std::vector<SystemOption> chosen = Chosen(FindSystem(options.system), options.filter);
  if (options.json) {
    Json list = Json::array();
    for (const SystemOption& option : chosen) list.push_back(ToJson(option));
    fmt::print("{}", Dump({{"system", options.system}, {"options", list}}));
  } else {
    std::size_t width = 0;
    for (const SystemOption& option : chosen) width = std::max(width, option.path.size());
    for (const SystemOption& option : chosen) {
      const std::string value = option.value + (option.unit.empty() ? "" : " " + option.unit);
      fmt::print("{:{}}  {:12}  {} ({})\n", option.path, width, value, option.help,
                 AllowedOf(option));
    }
  }
  if (!chosen.empty()) return kAllPassed;
  fmt::print(stderr, "aisle: no option of {} has '{}' in its path\n", options.system,
             options.filter);
  return kNothingToDo;
}

}  // namespace

void AddSystemsCommand(CLI::App* app, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app->add_subcommand(
      "systems", "List the systems that can be tested, or the options of one of them");
  command->add_option("NAME", options->system, "System whose options to list");
  command->add_option("FILTER", options->filter, "Only list options with this text in their path");
  AddJson(command, &options->json);
  command->footer("Example: ./aisle systems robust field");
  command->callback([=] {
    *action = [=] {
      return options->system.empty() ? PrintSystems(options->json) : PrintOptions(*options);
    };
  });
}

}  // namespace aisle
