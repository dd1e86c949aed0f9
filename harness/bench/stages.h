#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "harness/bench/source.h"
#include "harness/contract/estimate.h"
#include "harness/contract/system_spec.h"
#include "harness/contract/twin.h"

namespace aisle {

struct StageBenchOptions {
  BenchSource source{.twin = twin::kEmpty};
  SystemSpec system = BuiltIn("plain");
  int frames = 100;  ///< of the view's first, at most
  int laps = 1;      ///< drives over the same frames, one after the other
};

/// Milliseconds of one stage, of the frames in which it ran.
struct StageTime {
  std::vector<double> ms;

  double mean_ms() const;
  /// 0 to 1: 0.5 is the median. 0 without frames.
  double quantile_ms(double share) const;
};

/// So many times, rising, that stand for all: the middles of as many parts of equal share. What
/// `drive.latency_profile_ms` takes. Nothing without frames.
std::vector<double> LatencyProfile(const StageTime& time, int times = 20);

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
