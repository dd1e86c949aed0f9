#include <algorithm>
#include <chrono>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <thread>

#include "harness/campaign/bags.h"
#include "harness/campaign/campaign.h"
#include "harness/campaign/collect.h"
#include "harness/campaign/forecast.h"
#include "harness/campaign/guest_program.h"
#include "harness/campaign/inputs.h"
#include "harness/campaign/source.h"
#include "harness/cli/bag_notes.h"
#include "harness/cli/by_name.h"
#include "harness/cli/cluster_night.h"
#include "harness/cli/command.h"
#include "harness/cli/common_options.h"
#include "harness/cli/night_baseline.h"
#include "harness/cli/night_folder.h"
#include "harness/cli/publish.h"
#include "harness/cli/terminal.h"
#include "harness/contract/twin.h"
#include "harness/io/file.h"
#include "harness/io/frame_store.h"
#include "harness/io/input_error.h"
#include "harness/io/places.h"
#include "harness/io/shell_word.h"
#include "harness/judge/gate.h"
#include "harness/record/history.h"
#include "harness/record/provenance.h"
#include "harness/record/units.h"
#include "harness/report/picture/video.h"
#include "harness/report/report.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

struct Options {
  InputOptions inputs;
  std::string out;
  std::string shard = "1/1";
  int jobs = 1;
  int threads = 0;
  RunLimits limits;
  bool resume = false;
  bool no_frame_cache = false;
  bool no_video = false;
  bool debug_dynamic = false;
  bool mcap = false;
  std::string frames_in_report = "worst";
  bool no_retry = false;
  bool gate = false;
  std::string baseline;
  std::string allure;
  bool dry_run = false;
  bool json = false;
  ClusterChoice cluster;
};

std::atomic<bool> interrupted = false;
void OnInterrupt(int) { interrupted = true; }

/// What repeats this very campaign, but for where it goes: parts of one share their plan.
std::string CommandLine(const Options& options) {
  std::string line = OwnCommand() + " run " + Describe(options.inputs);
  if (options.gate) line += " --gate";
  if (!options.baseline.empty()) line += " --baseline " + ShellWord(options.baseline);
  return line;
}

/// Whether every value of the one is in the other.
template <class T>
bool HasAll(const std::vector<T>& all, const std::vector<T>& some) {
  return std::ranges::all_of(some, [&](const T& one) { return std::ranges::count(all, one) > 0; });
}

template <class T>
bool SameSet(const std::vector<T>& a, const std::vector<T>& b) {
  return HasAll(a, b) && HasAll(b, a);
}

/// Other systems, options or seeds than the suite's make medians of another kind: among the trends
/// they would stand as a night's. So would twins that were left out, as nights without some of
/// their cells; more twins than the suite's only add cells of their own. What says the same as the
/// suite in other words is a night of it.
bool IsTrial(const InputOptions& inputs, const std::vector<Suite>& suites) {
  const std::vector<Suite> as_written = LoadInputs({.files = inputs.files});
  return !std::ranges::equal(suites, as_written, [](const Suite& tonight, const Suite& written) {
    return SameSet(tonight.seeds, written.seeds) && SameSet(tonight.systems, written.systems) &&
           HasAll(tonight.twins, written.twins);
  });
}

/// When a night begins, UTC, to the millisecond: two of one second are two among the trends.
std::string NightStart() {
  using std::chrono::floor, std::chrono::milliseconds, std::chrono::seconds;
  const auto now = floor<milliseconds>(std::chrono::system_clock::now());
  const auto whole = floor<seconds>(now);
  const std::time_t time = whole.time_since_epoch().count();
  std::tm utc{};
  ::gmtime_r(&time, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%S", &utc);
  return fmt::format("{}.{:03}Z", text, (now - whole).count());
}

/// A baseline speaks of the suite as it is committed, and must be there, whole, before the night
/// begins. None where nobody asked for it.
std::optional<Results> ReadBaseline(const Options& options, const PlanFile& plan) {
  if (!options.gate) return std::nullopt;
  if (!options.inputs.set.empty()) {
    throw InputError(
        "--gate compares the committed suite with its baseline; --set is not supported");
  }
  const fs::path path =
      options.baseline.empty() ? BaselinePath(plan.name()) : fs::path(options.baseline);
  if (!fs::exists(path)) {
    throw InputError(path.string(), 0,
                     "no baseline for this suite; make one with `aisle baseline DIR`");
  }
  Results baseline = ResultsFromJson(ReadFile(path), path.string());
  if (baseline.runs.empty()) {
    throw InputError(path.string(), 0, "has no runs; make a new one with `aisle baseline DIR`");
  }
  CheckUnits(baseline, path.string());
  if (const std::string blind = BlindFor(baseline); !blind.empty()) {
    fmt::print(stderr, "aisle: warning: {}\n", blind);
  }
  return baseline;
}

void RefuseBoundToFail(const Results& baseline, const std::vector<RunSpec>& night) {
  const std::string why = BoundToFail(baseline, night);
  if (!why.empty()) throw InputError("--gate: " + why);
}

/// What the morning would find out, said in the evening; no reason not to drive.
void WarnOfHistory(const fs::path& out) {
  const std::string trouble = HistoryTrouble(HistoryPath(out));
  if (trouble.empty()) return;
  fmt::print(stderr, "aisle: warning: the trends will not include this run: {}\n", trouble);
}

CampaignOutcome RunToEnd(const Standing& night, const Options& options,
                         const ExpectedTimes& expected) {
  std::signal(SIGINT, OnInterrupt);
  std::signal(SIGTERM, OnInterrupt);
  ProgressLine line;
  return RunCampaign(night.todo,
                     {.at_once = options.jobs,
                      .limits = options.limits,
                      .retry = !options.no_retry,
                      .kept = night.kept,
                      .expected = expected,
                      .interrupted = &interrupted},
                     {.say =
                          [&](const std::string& text) {
                            line.Clear();
                            fmt::print(stderr, "{}\n", text);
                          },
                      .show = [&](const std::string& text) { line.Show(text); }});
}

void TellLimitsLeftOut(const std::vector<Suite>& suites) {
  std::size_t left_out = 0;
  for (const Suite& suite : suites) left_out += suite.limits_left_out;
  if (left_out == 0) return;
  fmt::print(stderr, "aisle: {} not judged, for systems or twins that were not selected\n",
             left_out == 1 ? "a limit is" : fmt::format("{} limits are", left_out));
}

void TellVideosMissing(const Options& options) {
  const bool made_here = !options.no_video && options.cluster.on.empty();
  if (!made_here || Video::Available()) return;
  fmt::print(stderr, "aisle: no videos of the runs: ffmpeg is not installed\n");
}

FramesOfRuns FramesOf(const Options& options, const Fingerprints& fingerprints) {
  return {.count = CountSourceFrames,
          .key = [&](const RunSpec& spec) { return fingerprints.Frames(spec); },
          .kept =
              [&](const std::string& key) {
                return options.no_frame_cache ? 0 : FrameStore(FramesFolder(key)).Count();
              },
          .steered = IsDriveSource};
}

/// What is ahead: of a night that goes on, without what is there of it.
void TellForecast(const std::vector<Job>& jobs, const Options& options,
                  const Fingerprints& fingerprints) {
  Standing standing{.todo = jobs};
  if (options.resume) standing = StandingOf(jobs, options.limits);
  if (standing.there() > 0) {
    fmt::print(stderr, "aisle: {} of {} runs are already done\n", standing.there(), jobs.size());
    if (standing.todo.empty()) return;
  }
  std::vector<RunSpec> specs;
  for (const Job& job : standing.todo) specs.push_back(job.spec);
  fmt::print(stderr, "aisle: {}\n",
             ToText(ForecastOf(specs, static_cast<int>(std::thread::hardware_concurrency()),
                               FramesOf(options, fingerprints))));
}

JobOptions JobOptionsOf(const Options& options, const fs::path& out) {
  return {.out = out,
          .threads = options.threads,
          .frame_cache = !options.no_frame_cache,
          .video = !options.no_video,
          .debug_dynamic = options.debug_dynamic,
          .mcap = options.mcap,
          .memory_mib = options.limits.memory_mib,
          .frames_in_report = options.frames_in_report};
}

/// What a cluster cannot do for us, said before anything is handed over.
void RefuseOnCluster(const Options& options, const Shard& shard) {
  if (shard.count > 1)
    throw InputError("--on splits the run into tasks itself; --shard is not supported");
  if (options.mcap) throw InputError("--on does not support --mcap");
  if (options.cluster.wait && options.cluster.on != "slurm") {
    throw InputError("--wait requires --on slurm; use kubectl wait for k8s");
  }
}

int HandOver(const Options& options, const PlanFile& plan, const std::vector<RunSpec>& specs,
             const Fingerprints& fingerprints, const std::optional<Results>& baseline,
             const fs::path& out, std::optional<FileLock> ours) {
  constexpr int kUsualThreads = 2;
  ClusterNight night{.plan = plan,
                     .runs = {},
                     .settings = {.threads = options.threads > 0 ? options.threads : kUsualThreads,
                                  .limits = options.limits,
                                  .retry = !options.no_retry,
                                  .frame_cache = !options.no_frame_cache,
                                  .video = !options.no_video,
                                  .debug_dynamic = options.debug_dynamic,
                                  .frames_in_report = options.frames_in_report,
                                  .remember = !plan.trial,
                                  .allure = options.allure,
                                  .gate = baseline.has_value(),
                                  .started = plan.started,
                                  .late_s = options.cluster.late_s},
                     .baseline = baseline,
                     .out = fs::absolute(out).lexically_normal(),
                     .resume = options.resume,
                     .dry_run = options.dry_run,
                     .json = options.json};
  for (const RunSpec& spec : specs) night.runs.push_back({spec, fingerprints.Run(spec)});
  return RunOnCluster(night, options.cluster, std::move(ours));
}

fs::path ReportFolder(const Options& options, const PlanFile& plan) {
  return options.out.empty() ? fs::path("out") / plan.name() : fs::path(options.out);
}

std::map<std::string, std::string> HashesOfScenes(const std::vector<Suite>& suites) {
  std::map<std::string, std::string> hashes;
  for (const Suite& suite : suites) {
    for (const SuiteScene& scene : suite.scenes) {
      if (scene.recorded || hashes.contains(scene.name)) continue;
      hashes.emplace(scene.name, fmt::format("{:016x}", HashSource(scene.file, twin::kLive, 0)));
    }
  }
  return hashes;
}

/// The plan with what its folder is to hold: tonight's, or that of the night which goes on there.
PlanFile ForFolder(PlanFile plan, const std::vector<RunSpec>& specs,
                   const Fingerprints& fingerprints, bool resume, const fs::path& out) {
  const auto inputs_of = [&](const RunSpec& spec) { return fingerprints.Run(spec); };
  for (const RunSpec& spec : specs) plan.inputs.emplace(RunId(spec), inputs_of(spec));
  plan.scenes = HashesOfScenes(plan.suites);
  const std::optional<PlanFile> before = resume ? FindPlan(out) : std::nullopt;
  return before ? Resumed(plan, *before, inputs_of) : plan;
}

int RunSuites(const Options& options) {
  const Shard shard = ShardFromText(options.shard);
  CheckAreThere(options.inputs.files);
  const std::vector<Suite> suites = LoadInputs(options.inputs);
  const PlanFile plan{.suites = suites,
                      .command = CommandLine(options),
                      .suite_file = options.inputs.files.front(),
                      .gate = options.gate,
                      .trial = IsTrial(options.inputs, suites),
                      .started = NightStart()};
  CheckScenes(plan.suites);
  TellNotesOfScenes(plan.suites);
  for (std::size_t i = 0; i < plan.suites.size(); ++i) {
    TellNotes(options.inputs.files[i], NotesOfSystems(plan.suites[i]));
  }
  TellLimitsLeftOut(plan.suites);
  TellVideosMissing(options);
  const std::optional<Results> baseline = ReadBaseline(options, plan);
  const Fingerprints fingerprints;
  const std::vector<RunSpec> night = Plan(plan.suites);
  if (baseline) RefuseBoundToFail(*baseline, night);
  const std::vector<RunSpec> specs = TakeShard(night, shard);
  if (specs.empty()) {
    fmt::print(stderr, "aisle: {}\n",
               shard.count > 1 ? fmt::format("part {} has no runs of the suite", options.shard)
                               : "no combination of scene, twin, seed and system can run: see the "
                                 "suite's twins and what its systems need");
    return kNothingToDo;
  }
  const fs::path out = ReportFolder(options, plan);
  const std::vector<Job> jobs = MakeJobs(specs, fingerprints, JobOptionsOf(options, out));
  TellForecast(jobs, options, fingerprints);
  if (!options.cluster.on.empty()) {
    RefuseOnCluster(options, shard);
    std::optional<FileLock> ours = options.dry_run ? std::nullopt : std::optional(TakeFolder(out));
    const PlanFile tonight = ForFolder(plan, specs, fingerprints, options.resume, out);
    return HandOver(options, tonight, specs, fingerprints, baseline, out, std::move(ours));
  }
  if (options.dry_run) return kAllPassed;
  const FileLock ours = TakeFolder(out);
  LeaveTheCluster(out);
  const bool whole = shard.count == 1;
  const bool remember = whole && !plan.trial;  // neither a part nor a trial is a night
  if (remember) WarnOfHistory(out);
  const ExpectedTimes expected = ExpectTimes(specs, out, FramesOf(options, fingerprints));
  RemoveReport(out);
  const Standing standing =
      options.resume ? Resume(jobs, options.limits) : Standing{.todo = AllToDo(jobs)};
  const PlanFile tonight = ForFolder(plan, specs, fingerprints, options.resume, out);
  WriteFileAtomically(out / "plan.json", ToJson(tonight));
  if (baseline) WriteNightBaseline(*baseline, out);
  const CampaignOutcome outcome = RunToEnd(standing, options, expected);
  if (!outcome.finished) {
    fmt::print(stderr, "aisle: interrupted; the same command with --resume continues from here\n");
    return kInterrupted;
  }
  if (options.mcap) {
    WriteBags(jobs, out, [](const std::string& text) { fmt::print(stderr, "{}\n", text); });
  }
  Results results = Collect(plan, specs, out, {.judge_limits = whole});
  results.started = tonight.started;
  results.wall_s = outcome.wall_s;
  results.rerun = plan.command + (options.out.empty() ? "" : " --out " + ShellWord(options.out));
  if (baseline && whole) HoldAgainstBaseline(*baseline, &results);
  return Publish(results, out,
                 {.json = options.json,
                  .remember = remember,
                  .allure = options.allure,
                  .failure = outcome.failure});
}

void AddSelection(CLI::App* command, Options* options) {
  InputOptions* inputs = &options->inputs;
  command
      ->add_option("SUITE_OR_SCENE", inputs->files,
                   "Suite or scene files, or names of those that come with aisle")
      ->required()
      ->transform(SuiteByName());
  command->option_defaults()->group("Selection");
  command
      ->add_option("--systems", inputs->systems,
                   "Systems to run, separated by commas; default: those of the suite")
      ->delimiter(',');
  AddTwins(command, &inputs->twins);
  command
      ->add_option("--seeds", inputs->seeds,
                   "Number of seeds to run, from 1 on; default: those of the suite")
      ->check(CLI::Range(1, 1000));
  command
      ->add_option("--seed", inputs->seed,
                   "Seeds to run, separated by commas; default: those of the suite")
      ->delimiter(',')
      ->excludes("--seeds");
  command->add_option("--set", inputs->set,
                      "Set an option of a system for a trial: SYSTEM.PATH=VALUE; `aisle systems` "
                      "lists the options");
  command->add_option("--shard", options->shard,
                      "Only run part I/N, for N machines; `aisle merge` joins the parts");
  command->add_flag("--resume", options->resume,
                    "Keep the finished runs of the report folder, unless their program, scene or "
                    "system has changed or a limit that ended them was raised");
  command->add_flag("--dry-run", options->dry_run,
                    "Check everything, print the number of runs and the time they will take, and "
                    "stop");
}

void AddOutputs(CLI::App* command, Options* options) {
  command->option_defaults()->group("Output");
  command->add_option("--out", options->out, "Report folder; default: out/SUITE");
  AddJson(command, &options->json, "Print results.json instead of the table");
  command->add_option("--allure", options->allure,
                      "Also write Allure results to this folder, for the CI's history of verdicts");
  command
      ->add_option("--frames-in-report", options->frames_in_report,
                   "Pictures that each run keeps: worst (two dozen, about 1 MB), all (every second "
                   "frame) or none; default: worst")
      ->check(CLI::IsMember({"worst", "all", "none"}));
  command->add_flag("--no-video", options->no_video, "Make no videos of the runs");
  command->add_flag("--debug-dynamic", options->debug_dynamic,
                    "Draw how `paper` and `robust` find moving objects: every stage of every frame "
                    "as a sheet (runs/ID/stages, about 0.7 MB each) and a video; never changes a "
                    "result. Runs that --resume keeps are not drawn");
  command->add_flag(
      "--mcap", options->mcap,
      "Write a ROS 2 bag of each scene, twin and seed with its frames, its truth and "
      "every system's output (bags/, about 0.7 MB per frame); never changes a result. "
      "Runs that --resume keeps are left out");
}

void AddJudging(CLI::App* command, Options* options) {
  command->option_defaults()->group("Judging");
  command->add_flag("--gate", options->gate,
                    "Also compare with the baseline; for parts, `aisle merge` does so");
  command
      ->add_option("--baseline", options->baseline,
                   "Baseline file for --gate; default: reports/baselines/SUITE.json")
      ->needs("--gate");
  command->add_flag("--no-retry", options->no_retry,
                    "Do not repeat failed runs to tell flaky from broken ones");
}

void AddLimits(CLI::App* command, Options* options) {
  command->option_defaults()->group("Limits");
  command->add_option("--jobs", options->jobs, "Number of runs at once; default: 1")
      ->check(CLI::Range(1, 256))
      ->excludes("--on");
  AddThreads(command, &options->threads, "never changes a result", "Number of threads per run");
  command
      ->add_option("--timeout", options->limits.wall_s,
                   "Most seconds of wall time per run; default: an hour plus the time that the "
                   "system's own `timeout_s` grants its commands")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--memory", options->limits.memory_mib,
                   "Most MiB of memory per run; default: 8192")
      ->check(CLI::PositiveNumber);
  command->add_flag("--no-frame-cache", options->no_frame_cache,
                    "Render every run's frames anew instead of sharing them");
}

}  // namespace

void AddRunCommand(CLI::App* app, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      app->add_subcommand("run", "Render, drive the systems, score, judge and report");
  AddSelection(command, options.get());
  AddOutputs(command, options.get());
  AddJudging(command, options.get());
  AddClusterChoice(command, &options->cluster);
  AddLimits(command, options.get());
  command->footer(
      "Example: ./aisle run scenes/suites/quickstart.yaml --seeds 3 --out out/tonight\n"
      "         ./aisle run scenes/paper/scene2.yaml --systems paper,robust --debug-dynamic\n"
      "         ./aisle run scenes/paper/scene2.yaml --systems robust --set "
      "robust.feature.features=800");
  command->callback([=] { *action = [=] { return RunSuites(*options); }; });
}

}  // namespace aisle
