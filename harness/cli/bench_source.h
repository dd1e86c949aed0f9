#pragma once

#include <CLI/CLI.hpp>
#include <limits>
#include <memory>
#include <string>

#include "harness/contract/sequence.h"

namespace aisle {

/// Where a bench takes its frames from.
struct BenchSource {
  std::string format = "euroc";  ///< of a recording
  std::string twin = "live";     ///< of a scene
  std::uint64_t seed = 1;        ///< of a scene
  std::string frames_dir = {};   ///< keeps what a scene renders; empty: nothing is kept
  int threads = 0;               ///< 0: all
};

/// --format, --twin, --seed, --frames-dir and --threads, with `source` as the defaults.
void AddSourceOptions(CLI::App* command, BenchSource* source);

/// A stretch of a scene or of a recording's folder: frames from `from` on, `to` not included.
struct BenchView {
  std::string source;
  int from = 0, to = std::numeric_limits<int>::max();
};

/// "SOURCE" or "SOURCE:FROM-TO". Throws InputError for a stretch that is none and a source that is
/// neither a scene nor a folder.
BenchView ParseView(const std::string& text);

/// The whole scene or recording. Kept frames lie in a folder of their own for each scene, twin and
/// seed, and are used whichever program made them.
std::unique_ptr<Sequence> OpenSource(const std::string& name, const BenchSource& source);

}  // namespace aisle
