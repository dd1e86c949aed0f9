#include <csignal>
#include <sstream>

#include "harness/cli/command.h"
#include "harness/cli/places.h"
#include "harness/cli/terminal.h"
#include "harness/io/file.h"
#include "harness/io/frame_store.h"
#include "harness/io/hash.h"
#include "harness/io/input_error.h"
#include "harness/plugs/simulated_sequence.h"
#include "harness/plugs/systems.h"
#include "harness/report/compare.h"
#include "harness/report/report.h"
#include "harness/report/twins.h"
#include "harness/run/stopwatch.h"
#include "harness/suite/schedule.h"
#include "harness/suite/suite.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kFrameStoreBytes = std::uintmax_t{12} << 30;

struct Options {
  std::vector<std::string> inputs;
  std::vector<std::string> systems, twins;
  std::uint64_t seeds = 0;          ///< a count; 0: the suite's own
  std::vector<std::uint64_t> seed;  ///< these very seeds
  std::string out;
  int jobs = 1;
  int threads = 0;
  double timeout_s = 3600;
  double memory_mib = 8192;
  bool resume = false;
  bool no_frame_cache = false;
  bool gate = false;
};

std::atomic<bool> interrupted = false;
void OnInterrupt(int) { interrupted = true; }

Vocabulary KnownNames() {
  Vocabulary vocabulary;
  for (const System& system : Systems()) vocabulary.systems.push_back(system.name);
  vocabulary.twins = TwinNames();
  return vocabulary;
}

/// A bare scene asks the plainest question of the plainest two systems.
Suite SuiteOfScene(const std::string& file) {
  const std::string name = SceneName(file);
  Suite suite;
  suite.name = fs::path(name).filename().string();
  suite.question = "How do the systems fare on " + name + "?";
  suite.scenes = {{name, fs::path(file).lexically_normal().string()}};
  suite.systems = {"orbslam2", "oracle"};
  return suite;
}

void CheckNames(const std::vector<std::string>& names, const std::vector<std::string>& known,
                const std::string& option) {
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw InputError(fmt::format("{}: '{}' is not known: expected one of {}", option,
                                 Printable(name), fmt::join(known, ", ")));
  }
}

Suite LoadInput(const std::string& file, const Options& options, const Vocabulary& vocabulary) {
  Suite suite = IsSuiteFile(file) ? LoadSuite(file, vocabulary) : SuiteOfScene(file);
  if (!options.systems.empty()) suite.systems = options.systems;
  if (!options.twins.empty()) suite.twins = options.twins;
  if (options.seeds > 0) {
    suite.seeds.clear();
    for (std::uint64_t seed = 1; seed <= options.seeds; ++seed) suite.seeds.push_back(seed);
  }
  if (!options.seed.empty()) suite.seeds = options.seed;
  return suite;
}

/// Several inputs make one report.
Suite LoadInputs(const Options& options) {
  const Vocabulary vocabulary = KnownNames();
  CheckNames(options.systems, vocabulary.systems, "--systems");
  CheckNames(options.twins, vocabulary.twins, "--twins");
  Suite whole = LoadInput(options.inputs.front(), options, vocabulary);
  for (std::size_t i = 1; i < options.inputs.size(); ++i) {
    const Suite more = LoadInput(options.inputs[i], options, vocabulary);
    whole.name += "+" + more.name;
    whole.question += " " + more.question;
    whole.scenes.insert(whole.scenes.end(), more.scenes.begin(), more.scenes.end());
    whole.externals.insert(more.externals.begin(), more.externals.end());
    whole.limits.insert(whole.limits.end(), more.limits.begin(), more.limits.end());
  }
  return whole;
}

/// Every mistake of every scene, before hours of work begin.
void CheckScenes(const Suite& suite) {
  std::string complaints;
  for (const SuiteScene& scene : suite.scenes) {
    for (const std::string& complaint : CheckScene(scene.file)) complaints += complaint + "\n";
  }
  if (complaints.empty()) return;
  complaints.pop_back();
  throw InputError(complaints);
}

/// Everything that decides the pixels of a run, and the program that makes them.
std::vector<Job> MakeJobs(const Suite& suite, const std::vector<RunSpec>& specs,
                          const Options& options, const fs::path& out) {
  const std::uint64_t program = HashFile(OwnExecutable(), HashFolder(AssetsDir()));
  std::vector<Job> jobs;
  for (const RunSpec& spec : specs) {
    const std::uint64_t scene = HashFile(spec.scene_file, program);
    const std::string key =
        fmt::format("{:016x}", Hash(fmt::format("{} {}", spec.twin, spec.seed), scene));
    Job job{.spec = spec, .argv = {}, .frames_key = key};
    job.argv = {OwnExecutable().string(),
                "run-one",
                "--scene",
                spec.scene,
                "--scene-file",
                spec.scene_file,
                "--twin",
                spec.twin,
                "--system",
                spec.system,
                "--seed",
                std::to_string(spec.seed),
                "--out",
                out.string(),
                "--threads",
                std::to_string(options.threads)};
    if (!options.no_frame_cache) {
      job.argv.insert(job.argv.end(), {"--frames", (CacheDir() / "frames" / key).string()});
    }
    const auto external = suite.externals.find(spec.system);
    if (external != suite.externals.end()) {
      const ExternalSystem& system = external->second;
      const std::string dataset = key + "-" + system.dataset;
      job.argv.insert(job.argv.end(), {"--external-command", system.command, "--external-dataset",
                                       system.dataset, "--external-trajectory", system.trajectory,
                                       "--external-timeout", fmt::format("{}", system.timeout_s),
                                       "--dataset", (CacheDir() / "datasets" / dataset).string()});
    }
    jobs.push_back(std::move(job));
  }
  return jobs;
}

std::string LastLine(const std::string& log) {
  std::istringstream stream(log);
  std::string line, last;
  while (std::getline(stream, line)) {
    if (!line.empty()) last = line;
  }
  return last;
}

/// The record of a run whose process did not live to write one.
RunRecord FailedRun(const RunSpec& spec, const ProcessResult& result, const ProcessLimits& limits) {
  RunRecord record;
  record.spec = spec;
  const bool out_of_bounds =
      result.end == ProcessResult::End::kTimeout || result.end == ProcessResult::End::kMemory;
  record.status = out_of_bounds ? RunStatus::kTimeout : RunStatus::kCrashed;
  record.status_why = Describe(result, limits);
  if (const std::string last = LastLine(result.log); !last.empty()) {
    record.status_why += "; last words: " + Printable(last, 160);
  }
  record.wall_s = result.wall_s;
  return record;
}

/// Follows the jobs: files failures, tells the user, remembers what went wrong with us.
class Evening {
 public:
  Evening(fs::path out, std::size_t total, const ProcessLimits& limits)
      : out_(std::move(out)), total_(total), limits_(limits) {}

  void Ended(const Job& job, const ProcessResult& result) {
    ++ended_;
    const std::string id = RunId(job.spec);
    const bool exited = result.end == ProcessResult::End::kExited;
    if (exited && (result.code == kOwnFailure || result.code == kBadInput)) {
      failure_ = std::max(failure_, result.code);
      Say(fmt::format("{}: {}", id, LastLine(result.log)));
      return;
    }
    if (!exited || result.code != 0) {
      const RunRecord record = FailedRun(job.spec, result, limits_);
      WriteFileAtomically(out_ / "runs" / id / "result.json", ToJson(record));
    }
    WriteFileAtomically(out_ / "runs" / id / "log.txt", result.log);
    const std::optional<RunRecord> record = ReadRun(job.spec, out_);
    Say(fmt::format("[{}/{}] {}  {}  {}", ended_, total_, id,
                    record ? Name(record->status) : "no result", Duration(result.wall_s)));
  }

  void Tick(const std::vector<JobProgress>& running) {
    std::string text = fmt::format("{}/{} runs", ended_, total_);
    double share = static_cast<double>(ended_);
    for (const JobProgress& one : running) {
      text += fmt::format(" | {} {}/{}", RunId(one.job->spec), one.done, one.total);
      if (one.total > 0) share += static_cast<double>(one.done) / one.total;
    }
    const double elapsed_s = watch_.ElapsedMs() * 1e-3;
    if (share > 0.02) {
      const double left_s = elapsed_s * (static_cast<double>(total_) - share) / share;
      text += " | " + Duration(left_s) + " left";
    }
    line_.Show(text);
  }

  /// 0, or the exit code of what failed on our side.
  int failure() const { return failure_; }
  double wall_s() const { return watch_.ElapsedMs() * 1e-3; }

 private:
  void Say(const std::string& text) {
    line_.Clear();
    fmt::print(stderr, "{}\n", text);
  }

  const fs::path out_;
  const std::size_t total_;
  const ProcessLimits limits_;
  std::size_t ended_ = 0;
  int failure_ = 0;
  Stopwatch watch_;
  ProgressLine line_;
};

std::string CommandLine(const Options& options) {
  std::string line = fmt::format("./aisle run {}", fmt::join(options.inputs, " "));
  if (!options.systems.empty())
    line += fmt::format(" --systems {}", fmt::join(options.systems, ","));
  if (!options.twins.empty()) line += fmt::format(" --twins {}", fmt::join(options.twins, ","));
  if (options.seeds > 0) line += fmt::format(" --seeds {}", options.seeds);
  if (!options.seed.empty()) line += fmt::format(" --seed {}", fmt::join(options.seed, ","));
  return line;
}

Results Collect(const Suite& suite, const std::vector<RunSpec>& specs, const fs::path& out) {
  Results results;
  results.provenance = OwnProvenance();
  results.suite = suite.name;
  results.question = suite.question;
  for (const RunSpec& spec : specs) {
    if (std::optional<RunRecord> record = ReadRun(spec, out)) results.runs.push_back(*record);
  }
  AddDynamicPenalty(&results.runs);
  results.verdicts = Judge(results.runs, suite.limits);
  return results;
}

void HoldAgainstBaseline(Results* results) {
  const fs::path path = BaselinePath(results->suite);
  const Results baseline = ResultsFromJson(ReadFile(path), path.string());
  for (Verdict& verdict : GateVerdicts(baseline, *results)) {
    results->verdicts.push_back(std::move(verdict));
  }
}

std::vector<RunSpec> StillToDo(const std::vector<RunSpec>& specs, const fs::path& out,
                               bool resume) {
  std::vector<RunSpec> todo;
  for (const RunSpec& spec : specs) {
    if (resume && ReadRun(spec, out)) continue;
    fs::remove(out / "runs" / RunId(spec) / "result.json");
    todo.push_back(spec);
  }
  return todo;
}

int RunSuite(const Options& options) {
  const std::string started = NowIso8601();
  const Suite suite = LoadInputs(options);
  CheckScenes(suite);
  if (options.gate && !fs::exists(BaselinePath(suite.name))) {
    throw InputError(BaselinePath(suite.name).string(), 0,
                     "no baseline for this suite; make one with `aisle baseline DIR`");
  }
  const std::vector<RunSpec> specs = Plan(suite);
  const fs::path out = options.out.empty() ? fs::path("out") / suite.name : fs::path(options.out);
  const std::vector<RunSpec> todo = StillToDo(specs, out, options.resume);
  if (specs.size() > todo.size()) {
    fmt::print(stderr, "aisle: {} of {} runs are already there\n", specs.size() - todo.size(),
               specs.size());
  }

  std::signal(SIGINT, OnInterrupt);
  std::signal(SIGTERM, OnInterrupt);
  const ProcessLimits limits{.wall_s = options.timeout_s, .memory_mib = options.memory_mib};
  Evening evening(out, todo.size(), limits);
  ShrinkStore(CacheDir() / "frames", kFrameStoreBytes);
  const bool finished = RunJobs(
      MakeJobs(suite, todo, options, out),
      {.jobs = options.jobs, .limits = limits, .interrupted = &interrupted},
      {.ended = [&](const Job& job, const ProcessResult& result) { evening.Ended(job, result); },
       .tick = [&](const std::vector<JobProgress>& running,
                   std::size_t) { evening.Tick(running); }});
  if (!finished) {
    fmt::print(stderr, "aisle: interrupted; the same command with --resume goes on from here\n");
    return kInterrupted;
  }

  Results results = Collect(suite, specs, out);
  results.started = started;
  results.wall_s = evening.wall_s();
  results.rerun = CommandLine(options);
  if (options.gate) HoldAgainstBaseline(&results);
  WriteReport(results, out);
  fmt::print("{}", ToConsole(results, StdoutHasColor()));
  fmt::print("report: {}\nagain:  {}\n", (out / "index.html").string(), results.rerun);
  if (evening.failure() != 0) return evening.failure();
  return AllPassed(results) ? kAllPassed : kVerdictFailed;
}

}  // namespace

void AddRunCommand(CLI::App* app, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      app->add_subcommand("run", "render, drive the systems, score, judge and report");
  command->add_option("SUITE_OR_SCENE", options->inputs, "suite or scene files")->required();
  command->add_option("--systems", options->systems, "instead of the suite's")->delimiter(',');
  command->add_option("--twins", options->twins, "live, empty, frozen; instead of the suite's")
      ->delimiter(',');
  command->add_option("--seeds", options->seeds, "how many seeds, from 1 on")
      ->check(CLI::Range(1, 1000));
  command->add_option("--seed", options->seed, "these very seeds")->delimiter(',');
  command->add_option("--out", options->out, "folder of the report; default out/SUITE");
  command->add_option("--jobs", options->jobs, "runs at once")->check(CLI::Range(1, 256));
  command->add_option("--threads", options->threads, "per run; 0: all; never changes a result")
      ->check(CLI::Range(0, 1024));
  command->add_option("--timeout", options->timeout_s, "seconds of wall time per run")
      ->check(CLI::PositiveNumber);
  command->add_option("--memory", options->memory_mib, "MiB of memory per run")
      ->check(CLI::PositiveNumber);
  command->add_flag("--resume", options->resume, "keep the finished runs of the report folder");
  command->add_flag("--gate", options->gate, "judge against the baseline too");
  command->add_flag("--no-frame-cache", options->no_frame_cache, "render anew for every run");
  command->footer("Example: ./aisle run scenes/suites/quickstart.yaml --seeds 3 --out out/tonight");
  command->callback([=] { *action = [=] { return RunSuite(*options); }; });
}

}  // namespace aisle
