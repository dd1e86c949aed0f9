// One task of a night on a cluster: all runs of one scene, twin and seed, made in the node's own
// scratch folder and copied into the report's.
#include <unistd.h>

#include <atomic>
#include <charconv>
#include <csignal>

#include "harness/campaign/campaign.h"
#include "harness/cli/cluster_commands.h"
#include "harness/cluster/scratch.h"
#include "harness/cluster/tasks.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/record/copy_run.h"
#include "harness/record/record.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string out;
  std::string index;
  std::size_t offset = 0;
};

std::atomic<bool> interrupted = false;
void OnInterrupt(int) { interrupted = true; }

/// The task's number in the list: ours, or the batch system's.
std::size_t IndexOf(const Options& options, std::size_t tasks) {
  std::string text = options.index;
  for (const char* variable : {"SLURM_ARRAY_TASK_ID", "JOB_COMPLETION_INDEX"}) {
    const char* given = std::getenv(variable);
    if (text.empty() && given != nullptr) text = given;
  }
  std::size_t index = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), index);
  index += options.offset;
  if (text.empty() || end.ec != std::errc() || end.ptr != text.data() + text.size() ||
      index >= tasks) {
    throw InputError(
        fmt::format("task '{}' + {}: expected a number below {} from --index, SLURM_ARRAY_TASK_ID "
                    "or JOB_COMPLETION_INDEX",
                    Printable(text), options.offset, tasks));
  }
  return index;
}

std::vector<RunSpec> Missing(const Task& task, const Fingerprints& fingerprints,
                             const RunLimits& limits, const fs::path& out) {
  std::vector<RunSpec> missing;
  for (const TaskRun& run : task.runs) {
    if (ReadFinishedRun(run.spec, run.inputs_hash, limits, out)) continue;
    if (fingerprints.Run(run.spec) != run.inputs_hash) {
      throw InputError(
          fmt::format("{}: this node has another program, scene, system or assets than those that "
                      "were submitted: make the same files visible here, or submit again",
                      RunId(run.spec)));
    }
    missing.push_back(run.spec);
  }
  return missing;
}

/// The job as it stands in the report's folder, for `rerun`; then the run, its result last.
void HandIn(Job job, const fs::path& scratch, const fs::path& out) {
  job.out = out;
  job.hidden.clear();
  WriteFileAtomically(JobPath(scratch, job.spec), ToJson(job));
  CopyRun(job.spec, scratch, out);
}

int RunTask(const Options& options) {
  std::signal(SIGINT, OnInterrupt);
  std::signal(SIGTERM, OnInterrupt);
  const fs::path out = fs::absolute(options.out).lexically_normal();
  const TaskList list = ReadTasks(out);
  const TaskSettings& settings = list.settings;
  const Task& task = list.tasks[IndexOf(options, list.tasks.size())];
  const Scratch scratch(fs::temp_directory_path());
  setenv("AISLE_CACHE", scratch.cache().c_str(), 0);  // a user's own choice stays
  const Fingerprints fingerprints;
  const std::vector<Job> jobs =
      MakeJobs(Missing(task, fingerprints, settings.limits, out), fingerprints,
               {.out = scratch.folder(),
                .threads = settings.threads,
                .frame_cache = settings.frame_cache,
                .video = settings.video,
                .debug_dynamic = settings.debug_dynamic,
                .memory_mib = settings.limits.memory_mib,
                .frames_in_report = settings.frames_in_report});
  int failure = 0;
  for (Job job : jobs) {  // one by one: what is done is handed in before a limit comes
    job.hidden = {out, scratch.home()};
    const CampaignOutcome outcome =
        RunCampaign({job},
                    {.at_once = 1,
                     .limits = settings.limits,
                     .retry = settings.retry,
                     .interrupted = &interrupted},
                    {.say = [](const std::string& text) { fmt::print(stderr, "{}\n", text); },
                     .show = [](const std::string&) {}});
    if (!outcome.finished) return kInterrupted;
    failure = std::max(failure, outcome.failure);
    if (ReadRun(job.spec, scratch.folder())) HandIn(job, scratch.folder(), out);
  }
  return failure;  // 0 with failed runs as well: their verdict is written
}

}  // namespace

void AddRunTaskCommand(CLI::App* app, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app->add_subcommand("run-task", "Run one task of a run on a cluster");
  command->group("");  // batch systems call it; people need not
  command->add_option("DIR", options->out, "Report folder, shared by all nodes")->required();
  command->add_option("--index", options->index,
                      "Index of the task; default: SLURM_ARRAY_TASK_ID or JOB_COMPLETION_INDEX");
  command->add_option("--offset", options->offset, "Number to add to the index");
  command->callback([=] { *action = [=] { return RunTask(*options); }; });
}

}  // namespace aisle
