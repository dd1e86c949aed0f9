// Parts of a suite that ran on several machines, made one report again.
#include "harness/campaign/collect.h"
#include "harness/cli/command.h"
#include "harness/cli/common_options.h"
#include "harness/cli/merge_night.h"
#include "harness/cli/night_baseline.h"
#include "harness/cli/night_folder.h"
#include "harness/cli/publish.h"
#include "harness/cluster/tasks.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/io/places.h"
#include "harness/io/shell_word.h"
#include "harness/record/copy_run.h"
#include "harness/suite/plan.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string out;
  std::vector<std::string> parts;
  std::string submission;
  bool json = false;
};

/// A folder to join, and what was planned for it.
struct Part {
  std::string folder;
  PlanFile plan;
};

/// Throws InputError where they were not planned for one question.
std::vector<Part> ReadParts(const std::vector<std::string>& folders) {
  std::vector<Part> parts;
  for (const std::string& folder : folders) {
    parts.push_back({folder, ReadPlan(folder)});
    if (!SameQuestion(parts.front().plan, parts.back().plan)) {
      throw InputError(folder + "/plan.json", 0,
                       "differs from " + folders.front() +
                           "/plan.json: only parts of one suite and one command line can be "
                           "merged");
    }
    if (const auto scene = ChangedScene(parts.front().plan, parts.back().plan)) {
      throw InputError(folder + "/plan.json", 0,
                       fmt::format("was planned with another {} than {}/plan.json: the scene file "
                                   "changed between the parts; run both with the same one",
                                   Printable(*scene, 200), folders.front()));
    }
  }
  return parts;
}

/// The baseline that all parts brought along; none where the plan asks for no gate.
std::optional<Results> CommonBaseline(const std::vector<Part>& parts) {
  if (!parts.front().plan.gate) return std::nullopt;
  Results baseline = ReadNightBaseline(parts.front().folder);
  for (const Part& part : parts) {
    if (ToJson(ReadNightBaseline(part.folder)) == ToJson(baseline)) continue;
    throw InputError(part.folder + "/baseline.json", 0,
                     "differs from " + parts.front().folder +
                         "/baseline.json: run both parts against the same one");
  }
  return baseline;
}

/// A run of the plan and the part that has it.
struct Found {
  std::string part;
  RunRecord record;
};

std::string PathOf(const Found& run) { return run.part + "/runs/" + RunId(run.record.spec); }

/// Of each run the first part's that made it, and what else lies in the parts: an earlier night's
/// runs, which their part was not to make, or of other inputs.
struct FoundRuns {
  std::vector<Found> runs, leftovers;
};

/// Parts of before do not say what they were to make: all that they hold is theirs.
bool WasToMake(const PlanFile& plan, const RunRecord& record) {
  const auto at = plan.inputs.find(RunId(record.spec));
  return plan.inputs.empty() || (at != plan.inputs.end() && at->second == record.inputs_hash);
}

/// Throws InputError where two parts made a run of other inputs, or are of two programs: their
/// figures are of no one night.
void CheckOneNight(const Found& first, const Found* same, const Found& run) {
  if (same != nullptr && same->record.inputs_hash != run.record.inputs_hash) {
    throw InputError(PathOf(run), 0,
                     "was made by another program, scene or system than the same run in another "
                     "part: run both parts with the same commit");
  }
  if (SameProgram(first.record, run.record)) return;
  const auto commit = [](const Found& of) {
    return of.record.commit.empty() ? "unknown" : Printable(of.record.commit, 60);
  };
  throw InputError(PathOf(run), 0,
                   fmt::format("was made by another program (commit {}) than {} (commit {}): run "
                               "all parts with the same commit",
                               commit(run), PathOf(first), commit(first)));
}

FoundRuns FindRuns(const std::vector<RunSpec>& specs, const std::vector<Part>& parts) {
  FoundRuns found;
  for (const RunSpec& spec : specs) {
    bool taken = false;
    for (const Part& part : parts) {
      std::optional<RunRecord> record = ReadRun(spec, part.folder);
      if (!record) continue;
      Found run{part.folder, *std::move(record)};
      if (!WasToMake(part.plan, run.record)) {
        found.leftovers.push_back(std::move(run));
        continue;
      }
      if (!found.runs.empty()) {
        CheckOneNight(found.runs.front(), taken ? &found.runs.back() : nullptr, run);
      }
      if (!taken) found.runs.push_back(std::move(run));
      taken = true;
    }
  }
  return found;
}

void TellLeftovers(const std::vector<Found>& leftovers) {
  constexpr std::size_t kMost = 5;
  for (std::size_t i = 0; i < std::min(kMost, leftovers.size()); ++i) {
    fmt::print(stderr, "aisle: {}: left over from an earlier run, skipped\n", PathOf(leftovers[i]));
  }
  if (leftovers.size() > kMost) {
    fmt::print(stderr, "aisle: and {} more\n", leftovers.size() - kMost);
  }
}

/// The plan of the whole: its night began with the first of the parts.
PlanFile WholePlan(const std::vector<Part>& parts, const std::vector<Found>& runs) {
  PlanFile plan = parts.front().plan;
  plan.inputs.clear();
  for (const Found& run : runs) plan.inputs.emplace(RunId(run.record.spec), run.record.inputs_hash);
  for (const Part& part : parts) {
    const std::string& began = part.plan.started;
    if (plan.started.empty() || (!began.empty() && began < plan.started)) plan.started = began;
  }
  if (plan.started.empty()) plan.started = NowIso8601();  // parts of before do not say
  return plan;
}

bool IsSame(const fs::path& out, const std::string& part) {
  return fs::exists(out) && fs::equivalent(out, part);
}

/// The runs' folders as they are there, and nothing of what was here: of a run that no part has, an
/// earlier night's must not answer. A part that is joined with others in its own folder keeps its.
void Adopt(const std::vector<RunSpec>& specs, const FoundRuns& found,
           const std::vector<Part>& parts, const fs::path& out) {
  const auto is_out = [&](const auto& part) { return IsSame(out, part.folder); };
  if (std::none_of(parts.begin(), parts.end(), is_out)) {
    for (const RunSpec& spec : specs) RemoveFolder(out / "runs" / RunId(spec));
  }
  for (const Found& run : found.leftovers) {
    if (IsSame(out, run.part)) RemoveFolder(out / "runs" / RunId(run.record.spec));
  }
  for (const Found& run : found.runs) {
    if (IsSame(out, run.part)) continue;
    RemoveFolder(out / "runs" / RunId(run.record.spec));
    CopyRun(run.record.spec, run.part, out);
  }
}

/// The whole's folder, and those of the parts beside it: a `run` in any of them would change them
/// under us.
std::vector<FileLock> TakeFolders(const fs::path& out, const std::vector<Part>& parts) {
  std::vector<FileLock> locks;
  locks.reserve(parts.size() + 1);
  for (const Part& part : parts) {
    if (!IsSame(out, part.folder)) locks.push_back(ReadFromFolder(part.folder));
  }
  locks.push_back(TakeFolder(out));
  return locks;
}

/// A folder that the tasks of a cluster filled is whole in itself.
int MergeOwn(const Options& options) {
  const fs::path out = fs::absolute(options.out).lexically_normal();
  if (!HasTasks(out)) {
    throw InputError(options.out, 0,
                     "has no run of a cluster: name the folders of the parts after it");
  }
  // Who submitted it holds the folder for a moment after its jobs are there.
  const FileLock ours = options.submission.empty() ? TakeFolder(out) : WaitForFolder(out);
  return MergeNight(out, {.json = options.json, .submission = options.submission});
}

int Merge(const Options& options) {
  if (options.parts.empty()) return MergeOwn(options);
  const std::vector<Part> parts = ReadParts(options.parts);
  const std::vector<FileLock> ours = TakeFolders(options.out, parts);
  const std::vector<RunSpec> specs = Plan(parts.front().plan.suites);
  const std::optional<Results> baseline = CommonBaseline(parts);
  const FoundRuns found = FindRuns(specs, parts);
  const PlanFile plan = WholePlan(parts, found.runs);
  TellLeftovers(found.leftovers);
  LeaveTheCluster(options.out);
  RemoveReport(options.out);
  Adopt(specs, found, parts, options.out);
  WriteFileAtomically(fs::path(options.out) / "plan.json", ToJson(plan));
  if (baseline) WriteNightBaseline(*baseline, options.out);
  Results results = Collect(plan, specs, options.out);
  results.started = plan.started;
  for (const Found& run : found.runs) results.wall_s += run.record.wall_s;
  results.rerun = plan.command + " --out " + ShellWord(options.out);
  if (baseline) HoldAgainstBaseline(*baseline, &results);
  return Publish(results, options.out, {.json = options.json, .remember = !plan.trial});
}

}  // namespace

void AddMergeCommand(CLI::App* app, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app->add_subcommand(
      "merge",
      "Join the parts of `run --shard`, or the results of a cluster's tasks, into one report and "
      "judge it");
  command->add_option("OUT", options->out, "Folder of the whole report")->required();
  command->add_option("PART", options->parts, "Folders of the parts; none for a run on a cluster");
  command->add_option("--submission", options->submission, "Submission to judge")->group("");
  AddJson(command, &options->json, "Print results.json instead of the table");
  command->footer(
      "Example: ./aisle run scenes/suites/paper.yaml --shard 1/2 --out out/a   # one machine\n"
      "         ./aisle run scenes/suites/paper.yaml --shard 2/2 --out out/b   # another\n"
      "         ./aisle merge out/paper out/a out/b");
  command->callback([=] { *action = [=] { return Merge(*options); }; });
}

}  // namespace aisle
