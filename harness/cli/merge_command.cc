// Parts of a suite that ran on several machines, made one report again.
#include "harness/campaign/collect.h"
#include "harness/cli/command.h"
#include "harness/cli/merge_night.h"
#include "harness/cli/night_baseline.h"
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

PlanFile ReadPlan(const fs::path& folder) {
  const fs::path path = folder / "plan.json";
  return PlanFromJson(ReadFile(path), path.string());
}

/// The plan that all parts agree on.
PlanFile CommonPlan(const std::vector<std::string>& parts) {
  const PlanFile plan = ReadPlan(parts.front());
  for (const std::string& part : parts) {
    if (ToJson(ReadPlan(part)) == ToJson(plan)) continue;
    throw InputError(part + "/plan.json", 0,
                     "is another plan than " + parts.front() +
                         "/plan.json: only parts of one suite and one command line can be merged");
  }
  return plan;
}

/// The baseline that all parts brought along; none where the plan asks for no gate.
std::optional<Results> CommonBaseline(const PlanFile& plan, const std::vector<std::string>& parts) {
  if (!plan.gate) return std::nullopt;
  Results baseline = ReadNightBaseline(parts.front());
  for (const std::string& part : parts) {
    if (ToJson(ReadNightBaseline(part)) == ToJson(baseline)) continue;
    throw InputError(part + "/baseline.json", 0,
                     "is another baseline than " + parts.front() +
                         "/baseline.json: run both parts against the same one");
  }
  return baseline;
}

/// A run of the plan and the first of the parts that has it.
struct Found {
  std::string part;
  RunRecord record;
};

/// Throws InputError where two parts answer for other inputs, or were made by other programs: their
/// figures are of no one night.
std::vector<Found> FindRuns(const std::vector<RunSpec>& specs,
                            const std::vector<std::string>& parts) {
  std::vector<Found> found;
  for (const RunSpec& spec : specs) {
    std::optional<RunRecord> taken;
    for (const std::string& part : parts) {
      std::optional<RunRecord> record = ReadRun(spec, part);
      if (!record) continue;
      if (taken && taken->inputs_hash != record->inputs_hash) {
        throw InputError(part + "/runs/" + RunId(spec), 0,
                         "was made by another program, scene or system than the same run of "
                         "another part: run both parts with the same commit");
      }
      if (!found.empty() && !SameProgram(found.front().record, *record)) {
        throw InputError(
            part + "/runs/" + RunId(spec), 0,
            fmt::format("was made by another program (commit {}) than {}/runs/{} (commit {}): run "
                        "all parts with the same commit",
                        record->commit.empty() ? "unknown" : Printable(record->commit, 60),
                        found.front().part, RunId(found.front().record.spec),
                        found.front().record.commit.empty()
                            ? "unknown"
                            : Printable(found.front().record.commit, 60)));
      }
      if (taken) continue;
      taken = record;
      found.push_back({part, *std::move(record)});
    }
  }
  return found;
}

bool IsPart(const fs::path& out, const std::vector<std::string>& parts) {
  return std::any_of(parts.begin(), parts.end(), [&](const std::string& part) {
    return fs::exists(out) && fs::equivalent(out, part);
  });
}

/// The runs' folders as they are there, and nothing of what was here: of a run that no part has, an
/// earlier night's must not answer. A part that is joined with others in its own folder keeps its.
void Adopt(const std::vector<RunSpec>& specs, const std::vector<Found>& found,
           const std::vector<std::string>& parts, const fs::path& out) {
  if (!IsPart(out, parts)) {
    for (const RunSpec& spec : specs) RemoveFolder(out / "runs" / RunId(spec));
  }
  for (const Found& run : found) {
    if (fs::exists(out) && fs::equivalent(out, run.part)) continue;
    RemoveFolder(out / "runs" / RunId(run.record.spec));
    CopyRun(run.record.spec, run.part, out);
  }
}

/// A folder that the tasks of a cluster filled is whole in itself.
int MergeOwn(const Options& options) {
  const fs::path out = fs::absolute(options.out).lexically_normal();
  if (!HasTasks(out)) {
    throw InputError(options.out, 0,
                     "holds no night of a cluster: name the folders of the parts after it");
  }
  return MergeNight(out, {.json = options.json, .submission = options.submission});
}

int Merge(const Options& options) {
  if (options.parts.empty()) return MergeOwn(options);
  const PlanFile plan = CommonPlan(options.parts);
  const std::vector<RunSpec> specs = Plan(plan.suites);
  const std::optional<Results> baseline = CommonBaseline(plan, options.parts);
  const std::vector<Found> found = FindRuns(specs, options.parts);
  RemoveReport(options.out);
  Adopt(specs, found, options.parts, options.out);
  WriteFileAtomically(fs::path(options.out) / "plan.json", ToJson(plan));
  if (baseline) WriteNightBaseline(*baseline, options.out);
  Results results = Collect(plan, specs, options.out);
  results.started = NowIso8601();
  for (const Found& run : found) results.wall_s += run.record.wall_s;
  results.rerun = plan.command + " --out " + ShellWord(options.out);
  if (baseline) HoldAgainstBaseline(*baseline, &results);
  return Publish(results, options.out, {.json = options.json, .remember = !plan.trial});
}

}  // namespace

void AddMergeCommand(CLI::App* app, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app->add_subcommand(
      "merge",
      "join the parts of `run --shard`, or what a cluster's tasks left, into one "
      "report and judge it");
  command->add_option("OUT", options->out, "folder of the whole report")->required();
  command->add_option("PART", options->parts,
                      "folders of the parts; none for a night that a cluster drove");
  command->add_option("--submission", options->submission, "whose verdict it is")->group("");
  command->add_flag("--json", options->json, "results.json on stdout instead of the table");
  command->footer(
      "Example: ./aisle run scenes/suites/paper.yaml --shard 1/2 --out out/a   # one machine\n"
      "         ./aisle run scenes/suites/paper.yaml --shard 2/2 --out out/b   # another\n"
      "         ./aisle merge out/paper out/a out/b");
  command->callback([=] { *action = [=] { return Merge(*options); }; });
}

}  // namespace aisle
