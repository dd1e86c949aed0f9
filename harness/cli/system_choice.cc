#include "harness/cli/system_choice.h"

#include "harness/plugs/systems.h"

namespace aisle {

void AddSystemChoice(CLI::App* command, SystemChoice* choice) {
  command->add_option("--system", choice->name, "default " + choice->name);
  command->add_option("--set", choice->set,
                      "PATH=VALUE: an option of the system; `aisle systems` lists them");
}

SystemSpec SpecOf(const SystemChoice& choice) {
  SystemSpec spec = BuiltIn(choice.name);
  spec.options = OptionsFromText(choice.set, FindSystem(choice.name));
  return spec;
}

}  // namespace aisle
