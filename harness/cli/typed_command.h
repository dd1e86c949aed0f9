#pragma once

#include <string>
#include <vector>

namespace aisle {

/// A command as one may type it again: the launcher for the program's path, and without the options
/// that say only where things are kept or written (--into, --json, --out, --frames-dir and their
/// other names). Words that a shell would take apart are quoted.
std::string RepeatableCommand(const std::vector<std::string>& words);

/// The same of this very process.
std::string TypedCommand();

}  // namespace aisle
