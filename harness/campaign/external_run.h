#pragma once

#include <filesystem>

#include "harness/contract/external.h"
#include "harness/contract/run.h"
#include "harness/contract/sequence.h"
#include "harness/io/dataset.h"

namespace aisle {

struct ExternalRun {
  std::filesystem::path dataset;  ///< exported there once, for all external systems
  /// The run's own. What the system leaves is taken there once it has been looked at; it works in a
  /// folder below it that is gone afterwards.
  std::filesystem::path folder;
  std::vector<std::filesystem::path> hidden;  ///< what the system must not see
  std::uint64_t seed = 1;
  double memory_mib = 8192;  ///< of the system's processes together
  /// What wheels measured from frame to frame, where the system is to be handed it.
  std::optional<WheelMotions> odometry = {};
  std::function<PathOfRig()> open_path;  ///< called only when the dataset must be made
  /// Called now and then while the system works: seconds since it began, and the frames done and
  /// there are, 0 of 0 where it prints no "@progress DONE TOTAL".
  std::function<void(double seconds, int done, int total)> progress = {};
};

/// Where a foreign system works, below the folder of its run.
inline constexpr const char* kGuestFolder = "guest";

/// Lays out a dataset without truth for this run alone, runs the command in a process group of its
/// own, confined to its folders and with a scrubbed environment, and reads what it left. A crash, a
/// hang or a trajectory that is none is the system's verdict, not an exception. What it printed is
/// kept as system.log, what it left beside its trajectory as guest_output.h says.
RunResult RunExternal(const ExternalSystem& system, const Sequence& sequence,
                      const ExternalRun& run);

/// The command with its placeholders filled in, quoted for the shell.
std::string FillIn(const std::string& command, const std::map<std::string, std::string>& values);

}  // namespace aisle
