#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "harness/bench/source.h"

namespace aisle {

/// --format, --twin, --seed, --frames-dir and --threads, with `source` as the defaults.
void AddSourceOptions(CLI::App* command, BenchSource* source);

/// "SOURCE", "SOURCE:FROM-TO" or, of a scene, either with "@SEED". Throws InputError for a stretch
/// that is none and a source that is neither a scene nor a folder.
BenchView ParseView(const std::string& text);

/// A file of views, one a line; empty lines and those that begin with # are for the reader. Throws
/// InputError with file and line.
std::vector<BenchView> ReadViews(const std::string& file);

}  // namespace aisle
