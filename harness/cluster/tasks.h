#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/contract/run.h"
#include "harness/contract/run_limits.h"

namespace aisle {

/// A run of the plan, and the hash of all that decides it where it was planned: a node with another
/// program or other scenes must not answer for it.
struct TaskRun {
  RunSpec spec;
  std::string inputs_hash;
};

/// What one machine does at a time: all runs of one (scene, twin, seed), which share their frames.
struct Task {
  std::vector<TaskRun> runs;
  double cost_s = 0;  ///< of one core; only the order of tasks comes from it
};

/// What every task and the merge need to know besides the plan.
struct TaskSettings {
  int threads = 2;          ///< of a task
  RunLimits limits;         ///< of one run
  bool retry = true;        ///< failed runs once more, to tell flaky from broken
  bool frame_cache = true;  ///< keep rendered frames on the node
  bool video = true;        ///< where the node has an ffmpeg
  bool debug_dynamic = false;
  std::string frames_in_report = "worst";
  bool remember = true;  ///< the merge files the night among the trends
  std::string allure;    ///< folder for Allure results; empty: none
  bool gate = false;     ///< the merge holds the night against baseline.json
  std::string started;   ///< when it was submitted, UTC
  double late_s = 60;    ///< how long the merge waits for results that do not show yet
};

/// cluster/tasks.json of a report's folder: what an index of a job array means.
struct TaskList {
  TaskSettings settings;
  std::vector<Task> tasks;
};

using TaskCost = std::function<double(const std::vector<TaskRun>& runs)>;

/// The runs cut by scene, twin and seed, longest first (equals in the plan's order): taken in this
/// order, they end at most a third later than in the best one (Graham's bound).
std::vector<Task> CutIntoTasks(const std::vector<TaskRun>& runs, const TaskCost& cost);

std::string ToJson(const TaskList& list);
/// `specs` are the plan's runs. Throws InputError where the text is no task list of that plan.
TaskList TasksFromJson(const std::string& text, const std::string& file,
                       const std::vector<RunSpec>& specs);

void WriteTasks(const TaskList& list, const std::filesystem::path& out);
/// Throws InputError where the folder holds no task list, or none of its own plan.json.
TaskList ReadTasks(const std::filesystem::path& out);
/// Whether the folder was made for a cluster.
bool HasTasks(const std::filesystem::path& out);

/// The tasks that lack a finished run for their inputs and limits, by index, ascending.
std::vector<std::size_t> Unfinished(const TaskList& list, const std::filesystem::path& out);

}  // namespace aisle
