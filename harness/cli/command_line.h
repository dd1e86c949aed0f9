#pragma once

#include "harness/cli/command.h"

namespace aisle {

/// All commands of the program; when one is chosen, `*action` is set.
void AddCommands(CLI::App* app, Action* action);

/// Does what the arguments of main() ask for, and says on stderr why it could not. Returns an
/// ExitCode.
int RunCommandLine(int argc, const char* const* argv);

}  // namespace aisle
