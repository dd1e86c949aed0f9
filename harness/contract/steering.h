#pragma once

#include <string>
#include <vector>

namespace aisle {

/// How a system steers the vehicle of a closed drive; scenes without a `drive` do not look at it.
struct Steering {
  /// What the system takes for a frame, milliseconds: from the middle of the exposure until its
  /// pose can be used, but for frames that waited while it worked, which are older by their wait.
  double latency_ms = 0;
  /// Instead: measured times, milliseconds, one of which is drawn for each frame from (seed,
  /// frame). Empty: latency_ms holds.
  std::vector<double> latency_profile_ms = {};
  /// What happens to frames that arrive while the system works: "newest" keeps the newest for when
  /// it is done, "drop" keeps none, "pipeline": it takes every frame, answers are late only.
  std::string queue = "newest";
  bool scanner = false;           ///< a safety scanner stops the vehicle
  bool steered_by_truth = false;  ///< the system is shown the drive but does not steer it
  /// The way is taught first: the vehicle is led along it once, in the scene without actors, and
  /// then drives as the system's own map of that says. Needs a system that keeps a map.
  bool taught = false;
  std::string driver = "";  ///< pure_pursuit or kanayama; empty: as the scene says

  bool operator==(const Steering&) const = default;
};

}  // namespace aisle
