#pragma once

#include "harness/cli/command.h"

namespace aisle {

// Commands of a night on a cluster; each as those of command.h.
void AddRunTaskCommand(CLI::App* app, Action* action);
void AddStatusCommand(CLI::App* app, Action* action);

}  // namespace aisle
