#pragma once

#include <stdexcept>
#include <string>

#include "harness/contract/run.h"

namespace aisle {

/// An estimator broke, and knows how: a system in a process of its own that died, hung or spoke
/// nonsense. Ends the run with that status; any other exception ends it as kCrashed.
struct SystemFault : std::runtime_error {
  SystemFault(RunStatus which, const std::string& why) : std::runtime_error(why), status(which) {}
  RunStatus status;
};

}  // namespace aisle
