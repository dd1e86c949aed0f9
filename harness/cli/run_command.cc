#include <csignal>
#include <filesystem>

#include "harness/cli/collect.h"
#include "harness/cli/command.h"
#include "harness/cli/evening.h"
#include "harness/cli/inputs.h"
#include "harness/cli/jobs.h"
#include "harness/cli/places.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/judge/compare.h"
#include "harness/report/report.h"
#include "harness/suite/plan.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

struct Options {
  InputOptions inputs;
  std::string out;
  std::string shard = "1/1";
  int jobs = 1;
  int threads = 0;
  ProcessLimits limits;
  bool resume = false;
  bool no_frame_cache = false;
  bool no_video = false;
  bool debug_dynamic = false;
  bool no_retry = false;
  bool gate = false;
  bool json = false;
};

std::atomic<bool> interrupted = false;
void OnInterrupt(int) { interrupted = true; }

/// The runs that have no result for these very inputs; what else lies there is taken away.
std::vector<Job> StillToDo(std::vector<Job> jobs, const fs::path& out, bool resume) {
  std::vector<Job> todo;
  for (Job& job : jobs) {
    if (resume && ReadFinishedRun(job.spec, job.inputs_hash, out)) continue;
    fs::remove_all(out / "runs" / RunId(job.spec));
    todo.push_back(std::move(job));
  }
  return todo;
}

bool IsFailure(const std::optional<RunRecord>& record) {
  return record && record->status != RunStatus::kOk && record->status != RunStatus::kLost;
}

/// Runs that failed are tried once more, elsewhere: the same inputs that end well the second time
/// make the run flaky. They never make it good.
bool LookForFlaky(const std::vector<Job>& jobs, const fs::path& out, const Options& options) {
  std::vector<Job> again;
  const fs::path elsewhere = out / "again";
  for (const Job& job : jobs) {
    if (!IsFailure(ReadRun(job.spec, out))) continue;
    again.push_back(job);
    auto& argv = again.back().argv;
    *(std::find(argv.begin(), argv.end(), "--out") + 1) = elsewhere.string();
    fs::remove_all(elsewhere / "runs" / RunId(job.spec));
  }
  if (again.empty()) return true;
  fmt::print(stderr, "aisle: {} failed; once more, to tell flaky from broken\n", again.size());
  Evening evening(elsewhere, again.size(), options.limits);
  if (!evening.Run(again, options.jobs, interrupted)) return false;
  for (const Job& job : again) {
    const std::optional<RunRecord> second = ReadRun(job.spec, elsewhere);
    std::optional<RunRecord> first = ReadRun(job.spec, out);
    if (!second || !first || IsFailure(second)) continue;
    first->flaky = true;
    first->status_why += "; a second attempt with the same inputs ended well";
    WriteFileAtomically(out / "runs" / RunId(job.spec) / "result.json", ToJson(*first));
  }
  return true;
}

void HoldAgainstBaseline(Results* results) {
  const fs::path path = BaselinePath(results->suite);
  const Results baseline = ResultsFromJson(ReadFile(path), path.string());
  for (Verdict& verdict : GateVerdicts(baseline, *results)) {
    results->verdicts.push_back(std::move(verdict));
  }
}

std::string CommandLine(const Options& options) {
  std::string line = "./aisle run " + Describe(options.inputs);
  if (options.gate) line += " --gate";
  return line;
}

int RunSuite(const Options& options) {
  const std::string started = NowIso8601();
  const Shard shard = ShardFromText(options.shard);
  const PlanFile plan{LoadInputs(options.inputs), CommandLine(options)};
  CheckScenes(plan.suite);
  if (options.gate && !fs::exists(BaselinePath(plan.suite.name))) {
    throw InputError(BaselinePath(plan.suite.name).string(), 0,
                     "no baseline for this suite; make one with `aisle baseline DIR`");
  }
  const std::vector<RunSpec> specs = TakeShard(Plan(plan.suite), shard);
  if (specs.empty()) {
    fmt::print(stderr, "aisle: part {} holds no run of the suite\n", options.shard);
    return kNothingToDo;
  }
  const fs::path out =
      options.out.empty() ? fs::path("out") / plan.suite.name : fs::path(options.out);
  const std::vector<Job> todo = StillToDo(MakeJobs(plan.suite, specs, Fingerprints(),
                                                   {.out = out,
                                                    .threads = options.threads,
                                                    .frame_cache = !options.no_frame_cache,
                                                    .video = !options.no_video,
                                                    .debug_dynamic = options.debug_dynamic}),
                                          out, options.resume);
  if (specs.size() > todo.size()) {
    fmt::print(stderr, "aisle: {} of {} runs are already there\n", specs.size() - todo.size(),
               specs.size());
  }
  WriteFileAtomically(out / "plan.json", ToJson(plan));

  std::signal(SIGINT, OnInterrupt);
  std::signal(SIGTERM, OnInterrupt);
  Evening evening(out, todo.size(), options.limits);
  bool finished = evening.Run(todo, options.jobs, interrupted);
  if (finished && !options.no_retry) finished = LookForFlaky(todo, out, options);
  if (!finished) {
    fmt::print(stderr, "aisle: interrupted; the same command with --resume goes on from here\n");
    return kInterrupted;
  }

  Results results = Collect(plan.suite, specs, out, {.judge_limits = shard.count == 1});
  results.started = started;
  results.wall_s = evening.wall_s();
  results.rerun = plan.command;
  if (options.gate) HoldAgainstBaseline(&results);
  return Publish(results, out, {.json = options.json, .failure = evening.failure()});
}

}  // namespace

void AddRunCommand(CLI::App* app, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      app->add_subcommand("run", "render, drive the systems, score, judge and report");
  InputOptions* inputs = &options->inputs;
  command->add_option("SUITE_OR_SCENE", inputs->files, "suite or scene files")->required();
  command->add_option("--systems", inputs->systems, "instead of the suite's")->delimiter(',');
  command
      ->add_option("--twins", inputs->twins,
                   "live, empty, frozen, none, low, mid, high; instead of the suite's")
      ->delimiter(',');
  command->add_option("--seeds", inputs->seeds, "how many seeds, from 1 on")
      ->check(CLI::Range(1, 1000));
  command->add_option("--seed", inputs->seed, "these very seeds")->delimiter(',');
  command->add_option("--out", options->out, "folder of the report; default out/SUITE");
  command->add_option("--shard", options->shard,
                      "only part I of N, for N machines; `aisle merge` joins the parts");
  command->add_option("--jobs", options->jobs, "runs at once")->check(CLI::Range(1, 256));
  command->add_option("--threads", options->threads, "per run; 0: all; never changes a result")
      ->check(CLI::Range(0, 1024));
  command->add_option("--timeout", options->limits.wall_s, "seconds of wall time per run")
      ->check(CLI::PositiveNumber);
  command->add_option("--memory", options->limits.memory_mib, "MiB of memory per run")
      ->check(CLI::PositiveNumber);
  command->add_flag("--resume", options->resume,
                    "keep the finished runs of the report folder, where program, scene and system "
                    "are still the same");
  command->add_flag("--gate", options->gate, "judge against the baseline too");
  command->add_flag("--no-frame-cache", options->no_frame_cache, "render anew for every run");
  command->add_flag("--no-video", options->no_video, "no film of the runs, ffmpeg or not");
  command->add_flag("--debug-dynamic", options->debug_dynamic,
                    "draw how `paper` and `robust` found what moves: every stage of every frame as "
                    "a sheet (runs/ID/stages, about 0.7 MB each) and a film; changes no result. "
                    "With --resume, finished runs are not drawn");
  command->add_flag("--no-retry", options->no_retry,
                    "do not try failed runs once more to tell flaky from broken");
  command->add_flag("--json", options->json, "results.json on stdout instead of the table");
  command->footer(
      "Example: ./aisle run scenes/suites/quickstart.yaml --seeds 3 --out out/tonight\n"
      "         ./aisle run scenes/paper/scene2.yaml --systems paper,robust --debug-dynamic");
  command->callback([=] { *action = [=] { return RunSuite(*options); }; });
}

}  // namespace aisle
