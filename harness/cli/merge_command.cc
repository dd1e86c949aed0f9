// Parts of a suite that ran on several machines, made one report again.
#include "harness/campaign/collect.h"
#include "harness/cli/command.h"
#include "harness/cli/merge_night.h"
#include "harness/cli/publish.h"
#include "harness/cluster/tasks.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/io/places.h"
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

/// The run's folder as it is there, and nothing of what was here.
void Adopt(const RunSpec& spec, const fs::path& from, const fs::path& to) {
  fs::remove_all(to / "runs" / RunId(spec));
  CopyRun(spec, from, to);
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
  double wall_s = 0;
  for (const RunSpec& spec : specs) {
    std::optional<RunRecord> taken;
    for (const std::string& part : options.parts) {
      const std::optional<RunRecord> record = ReadRun(spec, part);
      if (!record) continue;
      if (taken && taken->inputs_hash != record->inputs_hash) {
        throw InputError(part + "/runs/" + RunId(spec), 0,
                         "was made by another program, scene or system than the same run of "
                         "another part: run both parts with the same commit");
      }
      if (taken) continue;
      taken = record;
      wall_s += record->wall_s;
      if (!fs::exists(options.out) || !fs::equivalent(options.out, part)) {
        Adopt(spec, part, options.out);
      }
    }
  }
  WriteFileAtomically(fs::path(options.out) / "plan.json", ToJson(plan));
  Results results = Collect(plan, specs, options.out);
  results.started = NowIso8601();
  results.wall_s = wall_s;
  results.rerun = plan.command + " --out " + options.out;
  return Publish(results, options.out, {.json = options.json});
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
