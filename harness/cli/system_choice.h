#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "harness/contract/system_spec.h"

namespace aisle {

/// One of our systems, as a command line names it.
struct SystemChoice {
  std::string name;
  std::vector<std::string> set;  ///< "PATH=VALUE"
};

/// --system and --set, with `choice` as the default.
void AddSystemChoice(CLI::App* command, SystemChoice* choice);

/// Throws InputError for a system or an option that is not known, and for one that says how to
/// steer: commands with this choice let the system look on.
SystemSpec SpecOf(const SystemChoice& choice);

}  // namespace aisle
