#include "harness/cli/cluster_wait.h"

#include <fmt/ranges.h>

#include <atomic>
#include <csignal>
#include <thread>

#include "harness/cli/command.h"
#include "harness/cli/merge_night.h"
#include "harness/cli/night_folder.h"
#include "harness/cli/terminal.h"
#include "harness/cluster/slurm.h"
#include "harness/common/stopwatch.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/record/record.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

constexpr auto kPoll = std::chrono::seconds(2);

std::atomic<bool> interrupted = false;
void OnInterrupt(int) { interrupted = true; }

std::string QueueText(const std::optional<std::map<std::string, int>>& queue) {
  if (!queue) return "squeue does not respond";
  std::string text;
  for (const auto& [state, count] : *queue) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, state);
  }
  return text.empty() ? "no jobs in the queue" : text;
}

/// Runs with a result under its name; whether it answers for tonight's inputs is the merge's
/// question.
std::string RunsText(const TaskList& list, const fs::path& out) {
  std::size_t there = 0, total = 0;
  for (const Task& task : list.tasks) {
    for (const TaskRun& run : task.runs) {
      ++total;
      std::error_code error;
      if (fs::exists(out / "runs" / RunId(run.spec) / "result.json", error)) ++there;
    }
  }
  return fmt::format("{} of {} runs", there, total);
}

}  // namespace

std::string ClusterProgress(const TaskList& list, const fs::path& out,
                            const std::optional<Submission>& submission) {
  std::string text = RunsText(list, out);
  if (submission) text += " | " + QueueText(QueueOf(*submission));
  return text;
}

int WaitForVerdict(const fs::path& out, const WaitOptions& options) {
  const TaskList list = ReadTasks(out);
  const std::optional<Submission> submission = ReadSubmission(out);
  if (!submission) throw InputError(out.string(), 0, "nothing was submitted from this folder");
  std::signal(SIGINT, OnInterrupt);
  std::signal(SIGTERM, OnInterrupt);
  ProgressLine line;
  Stopwatch gone;  // since when no job of it is in the queue, where none is
  while (!interrupted) {
    const std::optional<ClusterVerdict> verdict = ReadVerdict(out);
    if (verdict && verdict->submission == submission->id) {
      line.Clear();
      fmt::print("{}", ReadFile(out / (options.json ? "results.json" : "summary.txt")));
      return verdict->exit_code;
    }
    const auto queue = QueueOf(*submission);
    line.Show(RunsText(list, out) + " | " + QueueText(queue));
    if (!queue || !queue->empty()) {
      gone = Stopwatch();
    } else if (gone.ElapsedMs() * 1e-3 > list.settings.late_s) {
      line.Clear();
      fmt::print(stderr, "aisle: the jobs ended without a verdict: merging here\n");
      const FileLock ours = WaitForFolder(out);
      if (const auto made = ReadVerdict(out); made && made->submission == submission->id) {
        continue;  // by another who waited
      }
      return MergeNight(out, {.json = options.json, .submission = submission->id});
    }
    std::this_thread::sleep_for(kPoll);
  }
  line.Clear();
  fmt::print(
      stderr,
      "aisle: stopped waiting; the jobs continue, and --resume --wait waits for them again\n");
  return kInterrupted;
}

}  // namespace aisle
