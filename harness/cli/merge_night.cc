#include "harness/cli/merge_night.h"

#include <thread>

#include "harness/campaign/collect.h"
#include "harness/cli/night_baseline.h"
#include "harness/cli/night_folder.h"
#include "harness/cli/publish.h"
#include "harness/cluster/slurm.h"
#include "harness/cluster/submission.h"
#include "harness/cluster/tasks.h"
#include "harness/common/stopwatch.h"
#include "harness/io/file.h"
#include "harness/io/shell_word.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

void WaitForLateResults(const TaskList& list, const fs::path& out) {
  const Stopwatch watch;
  while (!Unfinished(list, out).empty() && watch.ElapsedMs() * 1e-3 < list.settings.late_s) {
    std::this_thread::sleep_for(std::chrono::seconds(2));
  }
}

/// Processor time is not known; the sum of the runs' own is.
double WallOf(const Results& results) {
  double wall_s = 0;
  for (const RunRecord& run : results.runs) wall_s += run.wall_s;
  return wall_s;
}

/// What lies there from another program or scene answers another question: as if it were not there.
void DropForeignResults(const TaskList& list, const fs::path& out) {
  for (const Task& task : list.tasks) {
    for (const TaskRun& run : task.runs) {
      const std::optional<RunRecord> record = ReadRun(run.spec, out);
      if (record && record->inputs_hash != run.inputs_hash) {
        RemoveFolder(out / "runs" / RunId(run.spec));
      }
    }
  }
}

/// The submission that a merge by hand answers: the folder's, once its jobs have ended, or none of
/// a name where aisle submitted nothing. None while jobs may be to come: theirs is the verdict.
std::optional<std::string> AnsweredByHand(const TaskList& list, const fs::path& out) {
  const std::optional<Submission> submission = ReadSubmission(out);
  if (!submission) return "";
  if (Unfinished(list, out).empty()) return submission->id;
  const auto queue = QueueOf(*submission);
  return queue && queue->empty() ? std::optional(submission->id) : std::nullopt;
}

}  // namespace

int MergeNight(const fs::path& out, const MergeNightOptions& options) {
  const TaskList list = ReadTasks(out);
  const PlanFile plan = ReadPlan(out);
  WaitForLateResults(list, out);
  DropForeignResults(list, out);
  Results results = Collect(plan, Plan(plan.suites), out);
  results.started = list.settings.started;
  results.wall_s = WallOf(results);
  results.rerun = plan.command + " --out " + ShellWord(out.string());
  if (list.settings.gate) HoldAgainstBaseline(ReadNightBaseline(out), &results);
  const int code = Publish(
      results, out,
      {.json = options.json, .remember = list.settings.remember, .allure = list.settings.allure});
  const std::optional<std::string> answered =
      options.submission.empty() ? AnsweredByHand(list, out) : options.submission;
  if (answered) WriteVerdict({.submission = *answered, .exit_code = code}, out);
  return code;
}

}  // namespace aisle
