#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/cluster/tasks.h"
#include "harness/io/file_lock.h"
#include "harness/record/results.h"
#include "harness/suite/plan.h"

namespace aisle {

/// `run --on`: who makes the runs instead of this machine.
struct ClusterChoice {
  std::string on;  ///< "slurm", "k8s"; empty: this machine
  std::string partition, time;
  std::string image;  ///< empty: aisle:VERSION
  std::string claim;  ///< of a volume; empty: aisle
  int nodes_at_most = 0;
  double late_s = 60;
  bool wait = false;
};

/// Adds the options of it.
void AddClusterChoice(CLI::App* command, ClusterChoice* choice);

/// A night as a cluster is to drive it.
struct ClusterNight {
  PlanFile plan;
  std::vector<TaskRun> runs;
  TaskSettings settings;
  std::optional<Results> baseline;  ///< held against the night by the merge
  std::filesystem::path out;        ///< absolute, the same on every node
  bool resume = false, dry_run = false, json = false;
};

/// Whether jobs that were submitted for the folder wait or run: what their numbers mean, and what
/// they leave, must not change under them. Throws MachineError where the queue does not answer.
bool IsUnderWay(const std::filesystem::path& out);

/// Writes the plan and hands what is missing to the batch system; `wait` follows it to the verdict.
/// `ours` holds the folder until the jobs are handed over: their merge takes it. Returns an exit
/// code: the verdict's where it waited, 0 where the jobs are handed over. Throws InputError and
/// MachineError.
int RunOnCluster(const ClusterNight& night, const ClusterChoice& choice,
                 std::optional<FileLock> ours);

}  // namespace aisle
