#include "harness/vehicle/watch.h"

#include <fmt/format.h>

#include <cmath>

#include "harness/common/seconds.h"

namespace aisle {

std::string WatchOptions::Validate() const {
  if (!(late_s > 0)) return fmt::format("late_s is {}, it must be more than 0", late_s);
  if (!(stop_s > late_s)) return fmt::format("stop_s is {}, it must be more than late_s", stop_s);
  if (lost_frames < 1) return fmt::format("lost_frames is {}, it must be 1 or more", lost_frames);
  if (good_frames < 1) return fmt::format("good_frames is {}, it must be 1 or more", good_frames);
  if (!(jump_m > 0)) return fmt::format("jump_m is {}, it must be more than 0", jump_m);
  if (!(latency_s >= 0)) return fmt::format("latency_s is {}, it must not be negative", latency_s);
  return "";
}

WatchState AfterAnswer(WatchState state, bool has_pose, double jump_m, std::int64_t now_ns,
                       const WatchOptions& options) {
  if (!has_pose) {
    ++state.lost_in_row;
    state.good_in_row = 0;
    const bool creeps = state.trust == Trust::kGood && state.lost_in_row >= options.lost_frames;
    if (creeps) state.trust = Trust::kCreep;
    return state;
  }
  state.lost_in_row = 0;
  if (state.trust == Trust::kStop) {
    state.good_in_row = jump_m <= options.jump_m ? state.good_in_row + 1 : 0;
    if (state.good_in_row < options.good_frames) return state;
  }
  state.good_in_row = 0;
  state.trust = Trust::kGood;
  state.last_pose_ns = now_ns;
  return state;
}

WatchState AfterTime(WatchState state, std::int64_t now_ns, const WatchOptions& options) {
  if (state.trust == Trust::kFirst) return state;
  const double since_s = ToSeconds(now_ns - state.last_pose_ns);
  if (state.trust == Trust::kGood && since_s > options.late_s + options.latency_s) {
    state.trust = Trust::kCreep;
  }
  if (state.trust == Trust::kCreep && since_s > options.stop_s + options.latency_s) {
    state.trust = Trust::kStop;
  }
  return state;
}

}  // namespace aisle
