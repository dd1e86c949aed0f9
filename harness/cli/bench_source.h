#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "harness/bench/source.h"

namespace aisle {

/// --format, --twin, --seed, --frames-dir and --threads, with `source` as the defaults.
void AddSourceOptions(CLI::App* command, BenchSource* source);

/// "SOURCE" or "SOURCE:FROM-TO". Throws InputError for a stretch that is none and a source that is
/// neither a scene nor a folder.
BenchView ParseView(const std::string& text);

}  // namespace aisle
