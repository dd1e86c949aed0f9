#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "harness/campaign/job.h"
#include "harness/campaign/process.h"
#include "harness/campaign/time_left.h"
#include "harness/contract/run_limits.h"

namespace aisle {

struct ScheduleOptions {
  int jobs = 1;  ///< processes at once
  RunLimits limits;
  const std::atomic<bool>* interrupted = nullptr;  ///< set from outside: stop soon
};

/// What the job's process is held to.
ProcessLimits ProcessLimitsOf(const Job& job, const RunLimits& limits);

struct ScheduleEvents {
  /// The command line of a job's process.
  std::function<std::vector<std::string>(const Job&)> argv;
  std::function<void(const Job&, const ProcessResult&)> ended;
  /// Some ten times a second: what is running now, and how many jobs have ended.
  std::function<void(const std::vector<JobProgress>&, std::size_t ended)> tick;
};

/// The order in which few workers are done soon: jobs of the same frames stay together, since kept
/// frames are bounded; the group that takes longest comes first, and in it the longest job. Equals,
/// and those without a time, keep their order.
std::vector<Job> LongestFirst(const std::vector<Job>& jobs, const ExpectedTimes& expected);

/// Runs every job, in order where there is room. True if all ended; false if interrupted (running
/// children are killed: they leave nothing half-written under a final name). A process that cannot
/// be started is tried again while others run; throws MachineError where none does.
bool RunJobs(const std::vector<Job>& jobs, const ScheduleOptions& options,
             const ScheduleEvents& events);

}  // namespace aisle
