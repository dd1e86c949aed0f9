#pragma once

#include <filesystem>

#include "harness/contract/external.h"
#include "harness/contract/run.h"
#include "harness/contract/sequence.h"
#include "harness/io/dataset.h"

namespace aisle {

struct ExternalRun {
  std::filesystem::path dataset;  ///< exported there once, shared by all external systems
  std::filesystem::path output;   ///< where the system leaves its trajectory
  std::filesystem::path log;
  std::uint64_t seed = 1;
  std::function<PathOfRig()> open_path;  ///< called only when the dataset must be made
};

/// Exports the sequence, runs the command in a process group of its own and reads what it left. A
/// crash, a hang or a trajectory that is none is the system's verdict, not an exception.
RunResult RunExternal(const ExternalSystem& system, const Sequence& sequence,
                      const ExternalRun& run);

/// The command with its placeholders filled in, quoted for the shell.
std::string FillIn(const std::string& command, const std::map<std::string, std::string>& values);

}  // namespace aisle
