// One run of a finished report again, held against itself bit by bit.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "harness/campaign/campaign.h"
#include "harness/cli/command.h"
#include "harness/cli/common_options.h"
#include "harness/cli/terminal.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/io/places.h"
#include "harness/judge/bits.h"
#include "harness/record/provenance.h"
#include "harness/record/record.h"
#include "harness/record/record_json.h"
#include "harness/record/results.h"
#include "harness/suite/plan.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string id, in, out;
  int threads = 0;
  RunLimits limits;
  bool debug_dynamic = false;
  bool json = false;
};

/// The job as it was run. Where there is none of that name, the message says what there is.
Job FindJob(const std::string& id, const std::string& folder) {
  const fs::path plan_path = fs::path(folder) / "plan.json";
  const PlanFile plan = PlanFromJson(ReadFile(plan_path), plan_path.string());
  std::string known;
  for (const RunSpec& spec : Plan(plan.suites)) {
    if (RunId(spec) == id) return ReadJob(JobPath(folder, spec));
    if (known.size() < 400) known += "\n  " + RunId(spec);
  }
  throw InputError(fmt::format("{}: no run '{}'; it has{}", folder, Printable(id, 200), known));
}

/// The processor that made a run; of results of before that of their report, empty where its
/// results.json is not there or not whole.
std::string ProcessorOf(const std::optional<RunRecord>& run, const std::string& folder) {
  if (run && !run->cpu.empty()) return run->cpu;
  try {
    return ReadResults(folder).provenance.cpu;
  } catch (const InputError&) {
    return "";
  }
}

/// How the new run compares with the old one, for people or for programs.
int Say(const Options& options, const fs::path& out, const std::optional<RunRecord>& before,
        const std::optional<RunRecord>& after) {
  const bool both = before && after;
  const std::vector<std::string> differences =
      both ? DifferentBits(*before, *after) : std::vector<std::string>{};
  const bool same_inputs = both && before->inputs_hash == after->inputs_hash;
  const std::string run = (out / "runs" / options.id).string();
  const std::string processor = ProcessorOf(before, options.in), own = OwnProvenance().cpu;
  const bool same_processor = processor.empty() || processor == own;
  if (options.json) {
    fmt::print("{}", Dump({{"run", run},
                           {"compared", both},
                           {"same_inputs", same_inputs},
                           {"same_processor", same_processor},
                           {"differences", differences}}));
  } else if (!both) {
    fmt::print("run: {}\nno earlier result to compare with\n", run);
  } else if (differences.empty()) {
    fmt::print("run: {}\nidentical to the last bit: trajectories and {} scores\n", run,
               after->scores.size());
  } else {
    fmt::print("run: {}\n{}\n", run,
               same_inputs ? "same inputs, different results:"
                           : "program, scene or system changed since then; different results:");
    for (const std::string& line : differences) fmt::print("  {}\n", line);
    if (!same_processor) {
      fmt::print(
          "  made on {}, repeated on {}: equal bits are only promised on the same processor "
          "model\n",
          processor, own);
    }
  }
  return differences.empty() || !same_processor ? kAllPassed : kVerdictFailed;
}

/// The same run by this program, into a folder of its own.
Job AsOfNow(const RunSpec& spec, const Options& options, const fs::path& out) {
  const std::vector<Job> jobs = MakeJobs({spec}, Fingerprints(),
                                         {.out = out,
                                          .threads = options.threads,
                                          .debug_dynamic = options.debug_dynamic,
                                          .memory_mib = options.limits.memory_mib});
  return jobs.front();
}

int Rerun(const Options& options) {
  const Job job = FindJob(options.id, options.in);
  const std::optional<RunRecord> before = ReadRun(job.spec, options.in);
  const fs::path out = options.out.empty() ? fs::path(options.in) / "rerun" : fs::path(options.out);
  const std::vector<Job> again = AllToDo({AsOfNow(job.spec, options, out)});
  ProgressLine line;
  const CampaignOutcome outcome =
      RunCampaign(again, {.at_once = 1, .limits = options.limits, .retry = false},
                  {.say =
                       [&](const std::string& text) {
                         line.Clear();
                         fmt::print(stderr, "{}\n", text);
                       },
                   .show = [&](const std::string& text) { line.Show(text); }});
  line.Clear();
  if (outcome.failure != 0) return outcome.failure;
  return Say(options, out, before, ReadRun(job.spec, out));
}

}  // namespace

void AddRerunCommand(CLI::App* app, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      app->add_subcommand("rerun", "Repeat one run of a report and compare the results bit by bit");
  command->add_option("RUN-ID", options->id, "Run as the report names it: SCENE/TWIN/SYSTEM/SEED")
      ->required();
  command->add_option("--in", options->in, "Report folder that has the run")->required();
  command->add_option("--out", options->out, "Folder of the new run; default: DIR/rerun");
  AddThreads(command, &options->threads, "never changes a result");
  command
      ->add_option("--timeout", options->limits.wall_s,
                   "Most seconds of wall time; default: as for `run`")
      ->check(CLI::PositiveNumber);
  command->add_flag("--debug-dynamic", options->debug_dynamic,
                    "Draw every stage of the detector of moving objects, for every frame, into the "
                    "run's folder stages; never changes a result");
  AddJson(command, &options->json);
  command->footer("Example: ./aisle rerun paper.scene2/live/oracle/1 --in out/quickstart");
  command->callback([=] { *action = [=] { return Rerun(*options); }; });
}

}  // namespace aisle
