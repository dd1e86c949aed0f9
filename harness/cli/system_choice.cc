#include "harness/cli/system_choice.h"

#include "harness/io/input_error.h"
#include "harness/plugs/steering_options.h"
#include "harness/plugs/systems.h"

namespace aisle {

void AddSystemChoice(CLI::App* command, SystemChoice* choice) {
  command->add_option("--system", choice->name, "System to run; default: " + choice->name);
  command->add_option(
      "--set", choice->set,
      "Set an option of the system: PATH=VALUE; `aisle systems NAME` lists the options");
}

SystemSpec SpecOf(const SystemChoice& choice) {
  SystemSpec spec = BuiltIn(choice.name);
  spec.options = OptionsFromText(choice.set, FindSystem(choice.name));
  for (const auto& [path, value] : spec.options) {
    if (!IsSteeringOption(path)) continue;
    throw InputError(
        fmt::format("--set {}: this command does not steer; `aisle run` does, in scenes with a "
                    "`drive` (reports/docs/steering.md)",
                    path));
  }
  return spec;
}

}  // namespace aisle
