#pragma once

#include <functional>
#include <map>
#include <string>

#include "harness/bench/source.h"
#include "harness/contract/estimate.h"
#include "harness/contract/system_spec.h"

namespace aisle {

struct StageBenchOptions {
  BenchSource source{.twin = "empty"};
  SystemSpec system = BuiltIn("plain");
  int frames = 100;  ///< of the view's first, at most
  int laps = 1;      ///< drives over the same frames, one after the other
};

/// Mean and worst of one stage, milliseconds, over the frames in which it ran.
struct StageTime {
  double sum_ms = 0, worst_ms = 0;
  int count = 0;

  void Add(double ms) {
    sum_ms += ms;
    worst_ms = std::max(worst_ms, ms);
    ++count;
  }
  double mean_ms() const { return count == 0 ? 0 : sum_ms / count; }
};

/// What a lap has left behind: a map grows with the place explored, not with the time spent in it.
struct BenchLap {
  int index = 0;
  const FrameEstimate& last;  ///< of its last frame
  int lost = 0;               ///< frames that were not tracked
  double resident_mib = 0;    ///< what this process holds in memory; 0: the system does not say
};

/// Time by stage of a system, as it tells it; besides "set_up", "frame" (the whole call) and, over
/// a single lap, "reference": OpenCV's own ORB on both cameras, one after the other: what the same
/// machine, as busy as it is at that moment, makes of work that everybody knows.
std::map<std::string, StageTime> MeasureStages(
    const BenchView& view, const StageBenchOptions& options, const BenchProgress& progress = {},
    const std::function<void(const BenchLap&)>& lapped = {});

}  // namespace aisle
