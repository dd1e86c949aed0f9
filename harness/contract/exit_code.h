#pragma once

namespace aisle {

/// What the program ends with, alone or as the child that makes one run: pytest's codes, which
/// testers know.
enum ExitCode : int {
  kAllPassed = 0,
  kVerdictFailed = 1,
  kInterrupted = 2,  ///< and resumable
  kOwnFailure = 3,   ///< ours or the machine's
  kBadInput = 4,     ///< wrong usage, wrong files
  kNothingToDo = 5,  ///< nothing was selected
};

}  // namespace aisle
