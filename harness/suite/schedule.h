#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "harness/contract/run.h"
#include "harness/suite/process.h"

namespace aisle {

/// A run to be made by a process of its own.
struct Job {
  RunSpec spec;
  std::vector<std::string> argv;
  /// Jobs with the same frames. The first makes them, the others start when it has ended.
  std::string frames_key;
  std::string inputs_hash = {};  ///< of all that decides the run
};

struct ScheduleOptions {
  int jobs = 1;  ///< processes at once
  ProcessLimits limits;
  const std::atomic<bool>* interrupted = nullptr;  ///< set from outside: stop soon
};

struct JobProgress {
  const Job* job = nullptr;
  int done = 0, total = 0;  ///< frames
};

struct ScheduleEvents {
  std::function<void(const Job&, const ProcessResult&)> ended;
  /// Some ten times a second: what is running now, and how many jobs have ended.
  std::function<void(const std::vector<JobProgress>&, std::size_t ended)> tick;
};

/// Runs every job, in order where there is room. True if all ended; false if interrupted (running
/// children are killed: they leave nothing half-written under a final name).
bool RunJobs(const std::vector<Job>& jobs, const ScheduleOptions& options,
             const ScheduleEvents& events);

}  // namespace aisle
