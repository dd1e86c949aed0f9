#pragma once

#include <string>
#include <vector>

#include "harness/bench/source.h"
#include "harness/contract/system_spec.h"
#include "harness/contract/twin.h"

namespace aisle {

struct AccuracyBenchOptions {
  BenchSource source{.twin = twin::kEmpty};
  SystemSpec system = BuiltIn("plain");
  int starts = 9;  ///< drives per view
  int step = 1;    ///< frames from one start to the next
};

/// What became of one view: a value per start, where the start has one.
struct AccuracyOfView {
  std::size_t frames = 0;               ///< of the longest drive
  std::vector<double> live_m, final_m;  ///< ATE RMSE of the two tracks
  std::vector<double> frames_lost;      ///< frames without a live pose
};

/// Throws InputError where the last start would show no frame before `end`.
void CheckStarts(const BenchView& view, std::int64_t end, const AccuracyBenchOptions& options);

/// Drives the same pictures from several first frames. Throws InputError.
AccuracyOfView MeasureAccuracy(const BenchView& view, const AccuracyBenchOptions& options,
                               const BenchProgress& progress = {});

}  // namespace aisle
