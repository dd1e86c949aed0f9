#include "harness/cli/cluster_night.h"

#include <fmt/ranges.h>
#include <unistd.h>

#include <cmath>
#include <numeric>

#include "harness/campaign/campaign.h"
#include "harness/campaign/forecast.h"
#include "harness/campaign/source.h"
#include "harness/cli/cluster_wait.h"
#include "harness/cli/command.h"
#include "harness/cli/merge_night.h"
#include "harness/cli/night_baseline.h"
#include "harness/cli/publish.h"
#include "harness/cluster/kubernetes.h"
#include "harness/cluster/slurm.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/io/places.h"
#include "harness/io/shell_word.h"
#include "harness/record/provenance.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

/// Seconds by what the folder's last night took, where it has all of a task's runs; else by the
/// forecast.
TaskCost CostsOf(const fs::path& out) {
  return [out](const std::vector<TaskRun>& runs) {
    double last_s = 0;
    std::vector<RunSpec> specs;
    for (const TaskRun& run : runs) {
      const std::optional<RunRecord> record = ReadRun(run.spec, out);
      last_s = record ? last_s + record->wall_s : std::nan("");
      specs.push_back(run.spec);
    }
    if (!std::isnan(last_s)) return last_s;
    // A task has the frames of one scene, twin and seed.
    const FramesOfRuns ahead{.count = CountSourceFrames,
                             .key = [](const RunSpec&) { return std::string(); },
                             .kept = [](const std::string&) { return std::int64_t{0}; },
                             .steered = IsDriveSource};
    return ForecastOf(specs, 1, ahead).wall_s;
  };
}

SlurmOptions SlurmOf(const ClusterNight& night, const ClusterChoice& choice) {
  return {.name = "aisle-" + SafeName(night.plan.name()),
          .partition = choice.partition,
          .time = choice.time,
          .cpus = night.settings.threads,
          .at_most = choice.nodes_at_most};
}

SlurmPaths PathsOf(const ClusterNight& night) {
  return {.program = OwnExecutable(), .out = night.out, .working_folder = fs::current_path()};
}

KubernetesOptions KubernetesOf(const ClusterNight& night, const ClusterChoice& choice,
                               std::size_t tasks) {
  return {.name = night.plan.name(),
          .image = choice.image.empty() ? "aisle:" + OwnProvenance().version : choice.image,
          .claim = choice.claim.empty() ? "aisle" : choice.claim,
          .tasks = tasks,
          .at_most = choice.nodes_at_most,
          .cpus = night.settings.threads,
          .memory_mib = night.settings.limits.memory_mib,
          .out = night.out,
          .working_folder = fs::current_path()};
}

/// The scripts that would be submitted.
void ShowSlurm(const std::vector<std::size_t>& tasks, const ClusterNight& night,
               const ClusterChoice& choice) {
  constexpr std::size_t kUsualLimit = 1001;
  for (const ArrayPart& part : SplitArray(tasks, kUsualLimit)) {
    fmt::print("{}\n", TaskScript(part, SlurmOf(night, choice), PathsOf(night)));
  }
  fmt::print("{}", MergeScript("SUBMISSION", SlurmOf(night, choice), PathsOf(night)));
}

/// Takes away what another program or another question left: a half night is no answer. What says
/// that the last one is over goes first: should this one never begin, nothing speaks for it.
void ClearTheWay(const TaskList& list, bool resume, const fs::path& out) {
  ForgetNight(out);
  RemoveReport(out);
  for (const Task& task : list.tasks) {
    for (const TaskRun& run : task.runs) {
      const RunLimits& limits = list.settings.limits;
      if (resume && ResultThatStands(run.spec, run.inputs_hash, limits, out)) continue;
      RemoveFolder(out / "runs" / RunId(run.spec));
    }
  }
}

void WriteNight(const ClusterNight& night, const TaskList& list) {
  WriteFileAtomically(night.out / "plan.json", ToJson(night.plan));
  if (night.baseline) WriteNightBaseline(*night.baseline, night.out);
  WriteTasks(list, night.out);
}

int OnSlurm(const ClusterNight& night, const ClusterChoice& choice, const TaskList& list,
            std::optional<FileLock> ours) {
  if (IsUnderWay(night.out)) {
    if (!night.resume) {
      throw InputError(night.out.string(), 0,
                       "its jobs are still in the queue: `aisle status DIR` shows their progress; "
                       "scancel them, or wait for them with --resume --wait");
    }
    fmt::print(stderr, "aisle: its jobs are still in the queue: nothing new was submitted\n");
    ours.reset();
    return choice.wait ? WaitForVerdict(night.out, {.json = night.json}) : kAllPassed;
  }
  ClearTheWay(list, night.resume, night.out);
  WriteNight(night, list);
  const std::vector<std::size_t> missing = Unfinished(list, night.out);
  const std::string id = fmt::format("{}-{}", NowIso8601(), getpid());
  if (missing.empty()) {  // `status` asks for the verdict of a submission, though it has no job
    WriteSubmission({.id = id, .arrays = {}, .merge = {}}, night.out);
    return MergeNight(night.out, {.json = night.json, .submission = id});
  }
  const Submission submission = SubmitToSlurm(missing, id, SlurmOf(night, choice), PathsOf(night));
  fmt::print(stderr,
             "aisle: submitted tasks {} and merge {}; `{} status {}` shows their progress\n",
             fmt::join(submission.arrays, ", "), submission.merge, OwnCommand(),
             ShellWord(night.out.string()));
  ours.reset();
  return choice.wait ? WaitForVerdict(night.out, {.json = night.json}) : kAllPassed;
}

int OnKubernetes(const ClusterNight& night, const ClusterChoice& choice, const TaskList& list) {
  ClearTheWay(list, night.resume, night.out);
  WriteNight(night, list);
  const fs::path file = night.out / "cluster" / "jobs.yaml";
  const KubernetesOptions options = KubernetesOf(night, choice, list.tasks.size());
  WriteFileAtomically(file, KubernetesJobs(options));
  fmt::print("{}", KubernetesRecipe(options, file));
  return kAllPassed;
}

/// What the other kind of cluster alone would take.
void RefuseOfOther(const ClusterChoice& choice) {
  const auto refuse = [&](const std::string& value, const char* name, const char* kind) {
    if (value.empty() || choice.on == kind) return;
    throw InputError(fmt::format("{} requires --on {}", name, kind));
  };
  refuse(choice.partition, "--partition", "slurm");
  refuse(choice.time, "--task-time", "slurm");
  refuse(choice.image, "--image", "k8s");
  refuse(choice.claim, "--claim", "k8s");
}

}  // namespace

void AddClusterChoice(CLI::App* command, ClusterChoice* choice) {
  command->option_defaults()->group("Cluster");
  CLI::Option* on =
      command
          ->add_option(
              "--on", choice->on,
              "Run on a cluster: slurm submits a job array and a merge, k8s writes the Jobs "
              "as YAML; with --dry-run, only print what would be submitted")
          ->check(CLI::IsMember({"slurm", "k8s"}));
  command
      ->add_option("--partition", choice->partition,
                   "Slurm partition of the tasks; default: that of the site")
      ->needs(on);
  command
      ->add_option("--task-time", choice->time,
                   "Slurm time limit of a task, as sbatch takes it, for example 2:00:00")
      ->needs(on);
  command->add_option("--image", choice->image, "Container image with aisle for Kubernetes' Jobs")
      ->needs(on);
  command
      ->add_option("--claim", choice->claim,
                   "PersistentVolumeClaim of the report folder for Kubernetes' Jobs")
      ->needs(on);
  command
      ->add_option("--nodes-at-most", choice->nodes_at_most,
                   "Most tasks at once, and so most nodes in use")
      ->check(CLI::Range(1, 100000))
      ->needs(on);
  command
      ->add_option("--late", choice->late_s,
                   "Seconds that the merge waits for results which the shared file system does not "
                   "show yet")
      ->check(CLI::Range(0.0, 86400.0))
      ->needs(on);
  command
      ->add_flag("--wait", choice->wait,
                 "Wait for the Slurm jobs and exit with the verdict's exit code")
      ->needs(on);
}

bool IsUnderWay(const fs::path& out) {
  const std::optional<Submission> submission = ReadSubmission(out);
  if (!submission || submission->arrays.empty()) return false;
  const auto queue = QueueOf(*submission);
  if (queue) return !queue->empty();
  // A verdict comes when all tasks have ended.
  const std::optional<ClusterVerdict> verdict = ReadVerdict(out);
  if (verdict && verdict->submission == submission->id) return false;
  throw MachineError(out.string() +
                     ": squeue does not respond, and jobs of this folder may still be waiting");
}

int RunOnCluster(const ClusterNight& night, const ClusterChoice& choice,
                 std::optional<FileLock> ours) {
  RefuseOfOther(choice);
  const TaskList list{.settings = night.settings,
                      .tasks = CutIntoTasks(night.runs, CostsOf(night.out))};
  const bool slurm = choice.on == "slurm";
  if (night.dry_run) {
    std::vector<std::size_t> all(list.tasks.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    if (slurm) {
      ShowSlurm(night.resume ? Unfinished(list, night.out) : all, night, choice);
    } else {
      fmt::print("{}", KubernetesJobs(KubernetesOf(night, choice, list.tasks.size())));
    }
    return kAllPassed;
  }
  return slurm ? OnSlurm(night, choice, list, std::move(ours)) : OnKubernetes(night, choice, list);
}

}  // namespace aisle
