#pragma once

#include <cstdint>
#include <string>

namespace aisle {

/// When a vehicle no longer trusts the system that tells it where it is.
struct WatchOptions {
  double late_s = 0.3;   ///< without a pose for so long, beyond the latency it knows: creep
  int lost_frames = 3;   ///< so many answers in a row without a pose: creep
  double stop_s = 1.0;   ///< without a pose for so long: protective stop
  int good_frames = 10;  ///< so many poses in a row after a stop: go on
  double jump_m = 0.2;   ///< but not if they lie farther than this from where its wheels put it
  double latency_s = 0;  ///< known: so much time passes between two answers of a healthy system

  std::string Validate() const;  ///< the first broken rule, or an empty string
};

enum class Trust { kFirst, kGood, kCreep, kStop };

/// A plain value that goes from trust to trust. Times are nanoseconds.
struct WatchState {
  Trust trust = Trust::kFirst;    ///< kFirst: stands until there is a first pose
  std::int64_t last_pose_ns = 0;  ///< when the last pose arrived
  int lost_in_row = 0, good_in_row = 0;
  bool operator==(const WatchState&) const = default;
};

/// An answer arrived. `jump_m`: how far its pose lies from where the vehicle takes itself to be.
WatchState AfterAnswer(WatchState state, bool has_pose, double jump_m, std::int64_t now_ns,
                       const WatchOptions& options);

/// Time passed without one.
WatchState AfterTime(WatchState state, std::int64_t now_ns, const WatchOptions& options);

}  // namespace aisle
