#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/campaign/job.h"
#include "harness/campaign/progress.h"

namespace aisle {

/// What a run is thought to take, in seconds of one core.
struct ExpectedTime {
  double drive_s = 0;   ///< its frames there already
  double render_s = 0;  ///< of those, for the first of the runs that share them
};
using ExpectedTimes = std::map<std::string, ExpectedTime>;  ///< by RunId

struct JobProgress {
  const Job* job = nullptr;
  Progress progress;
};

/// How long jobs still take, by how fast those went that are done: what they were thought to take
/// tells how much of the work that was, and their time how much this machine makes of it.
class TimeLeft {
 public:
  /// `jobs` in the order in which they start. One without a time counts as the mean of the others.
  TimeLeft(const std::vector<Job>& jobs, const ExpectedTimes& expected);

  void Ended(const Job& job);

  /// Seconds, after `elapsed_s` of work; nothing while too little of it is done to tell.
  std::optional<double> Seconds(double elapsed_s, const std::vector<JobProgress>& running) const;

 private:
  double WorkOf(const Job& job) const;

  std::map<std::string, double> work_s_;  ///< by RunId
  double total_s_ = 0, done_s_ = 0;
};

}  // namespace aisle
