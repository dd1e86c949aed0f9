#pragma once

#include "harness/contract/stream.h"
#include "harness/contract/system_spec.h"

namespace aisle {

/// What one run may take.
struct RunLimits {
  double wall_s = 0;         ///< wall time; 0: as WallLimit_s says
  double memory_mib = 8192;  ///< of all its processes together

  bool operator==(const RunLimits&) const = default;
};

/// Wall time of a run of that system, seconds. Where nobody asks for one: an hour for what is ours,
/// and beside that what a command that reads a dataset is given by its own `timeout_s`.
inline double WallLimit_s(const RunLimits& limits, const SystemSpec& system) {
  constexpr double kOurs_s = 3600;
  if (limits.wall_s > 0) return limits.wall_s;
  const bool reads_dataset = system.external && !IsStream(*system.external);
  return kOurs_s + (reads_dataset ? system.external->timeout_s : 0);
}

}  // namespace aisle
