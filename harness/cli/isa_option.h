#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace aisle {

/// Adds `--isa`: the instruction set that the tracer uses, of those it has code for.
void AddIsaOption(CLI::App* command, std::string* isa);

}  // namespace aisle
