#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/cli/terminal.h"
#include "harness/run/stopwatch.h"
#include "harness/suite/schedule.h"

namespace aisle {

/// Follows the runs of an evening: files the failures of those that could not do it themselves,
/// tells the user, remembers what went wrong on our side.
class Evening {
 public:
  Evening(std::filesystem::path out, std::size_t total, const ProcessLimits& limits)
      : out_(std::move(out)), total_(total), limits_(limits) {}

  void Ended(const Job& job, const ProcessResult& result);
  void Tick(const std::vector<JobProgress>& running);

  /// Runs `jobs` to their end; false when interrupted.
  bool Run(const std::vector<Job>& jobs, int at_once, const std::atomic<bool>& interrupted);

  /// 0, or the exit code of what failed on our side.
  int failure() const { return failure_; }
  double wall_s() const { return watch_.ElapsedMs() * 1e-3; }

 private:
  void Say(const std::string& text);

  const std::filesystem::path out_;
  const std::size_t total_;
  const ProcessLimits limits_;
  std::size_t ended_ = 0;
  int failure_ = 0;
  Stopwatch watch_;
  ProgressLine line_;
};

}  // namespace aisle
