// Which commit of somebody's own SLAM broke a limit: a scene driven over its history.
#include <cmath>
#include <filesystem>
#include <thread>

#include "harness/campaign/bisect.h"
#include "harness/campaign/campaign.h"
#include "harness/campaign/inputs.h"
#include "harness/cli/command.h"
#include "harness/cli/common_options.h"
#include "harness/cli/terminal.h"
#include "harness/contract/twin.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/record/group.h"
#include "harness/record/record.h"
#include "harness/record/record_json.h"
#include "harness/score/score_names.h"
#include "harness/score/statistics.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string good, bad, suite, scene, twin = twin::kLive, system, limit, out = "out/bisect";
  std::vector<std::uint64_t> seed{1};
  RunLimits limits;
  bool json = false;
};

/// "ate_rmse_m<=0.03", "coverage>=0.9", or "completes".
struct Question {
  std::string score;  ///< empty: whether the runs complete
  bool at_most = true;
  double bound = 0;
};

Question QuestionFromText(const std::string& text) {
  if (text == "completes") return {};
  const std::size_t at = text.find_first_of("<>");
  Question question{.score = text.substr(0, at)};
  const bool relation = at != std::string::npos && text.compare(at + 1, 1, "=") == 0;
  if (!relation || !CLI::detail::lexical_cast(text.substr(at + 2), question.bound) ||
      !std::isfinite(question.bound) || !IsScoreName(question.score)) {
    throw InputError(
        fmt::format("--limit: expected 'completes', SCORE<=VALUE or SCORE>=VALUE with a score of "
                    "`aisle score --list`, for example 'ate_rmse_m<=0.03', got '{}'",
                    Printable(text)));
  }
  question.at_most = text[at] == '<';
  return question;
}

/// Whether the runs of one commit keep the limit, the median over seeds of a score.
CommitTrial Judge(const std::string& commit, const std::vector<RunRecord>& runs,
                  const Question& question) {
  CommitTrial trial{.commit = commit};
  if (runs.empty()) {  // silence is no pass
    trial.why = "a run left no result";
    return trial;
  }
  std::vector<const RunRecord*> all;
  for (const RunRecord& run : runs) {
    all.push_back(&run);
    if (IsComplete(run.status)) continue;
    trial.why = Name(run.status) + ": " + run.status_why;
    trial.state = question.score.empty() ? CommitState::kBad : CommitState::kCannotTell;
    return trial;
  }
  if (question.score.empty()) {
    trial.state = CommitState::kGood;
    trial.why = "completes";
    return trial;
  }
  const std::optional<double> median = MedianScore(all, question.score);
  if (!median) {
    trial.why = "no value for " + question.score;
    return trial;
  }
  const bool good = question.at_most ? *median <= question.bound : *median >= question.bound;
  trial.state = good ? CommitState::kGood : CommitState::kBad;
  trial.why = fmt::format("{} {:.5g}", question.score, *median);
  return trial;
}

/// The named system of the suite, which must say where its sources are and how they are built.
SystemSpec SystemToBuild(const Suite& suite, const Options& options) {
  std::vector<std::string> able;
  for (const SystemSpec& system : suite.systems) {
    if (!system.external || system.external->repository.empty()) continue;
    if (options.system.empty() || system.name == options.system) return system;
    able.push_back(system.name);
  }
  throw InputError(
      options.suite, 0,
      fmt::format("no system{} with 'repository' and 'build'{}; example: {{name: mine, "
                  "command: '{{source}}/build/mine {{dataset}} {{output}}', "
                  "repository: /srv/mine, build: cmake --build build}}",
                  options.system.empty() ? "" : " " + Printable(options.system),
                  able.empty() ? "" : fmt::format("; it has {}", fmt::join(able, ", "))));
}

std::string Name(CommitState state) {
  return state == CommitState::kGood ? "good" : state == CommitState::kBad ? "bad" : "cannot tell";
}

/// Builds and drives one commit after the other.
class Trials {
 public:
  Trials(const Options& options, Question question, Suite suite, SystemSpec system)
      : options_(options),
        question_(std::move(question)),
        suite_(std::move(suite)),
        system_(std::move(system)),
        source_(system_.external->repository, fs::path(options.out) / "source") {
    suite_.systems = {system_};
    suite_.systems.front().external->repository = source_.folder().string();
    suite_.twins = {options.twin};
    suite_.seeds = options.seed;
    std::erase_if(suite_.scenes,
                  [&](const SuiteScene& scene) { return scene.name != options.scene; });
    if (suite_.scenes.empty()) {
      throw InputError(options.suite, 0,
                       "no scene named " + Printable(options.scene) + " in its 'scenes'");
    }
  }

  CommitTrial Attempt(const std::string& commit) {
    const fs::path folder = fs::path(options_.out) / commit.substr(0, 12);
    source_.CheckOut(commit);
    CommitTrial trial{.commit = commit};
    if (const std::string trouble = Build(folder); !trouble.empty()) {
      trial.why = "the build failed: " + trouble;
    } else {
      trial = Judge(commit, Drive(folder), question_);
    }
    if (!options_.json) {
      fmt::print("{:11} {}\n            {}\n", Name(trial.state),
                 DescribeCommit(system_.external->repository, commit), trial.why);
      std::fflush(stdout);
    }
    return trial;
  }

 private:
  /// Why it cannot be built; empty where it can.
  std::string Build(const fs::path& folder) const {
    if (system_.external->build.empty()) return "";
    const ProcessLimits limits{.wall_s = WallLimit_s(options_.limits, {}),
                               .memory_mib = options_.limits.memory_mib};
    Process process(
        {"/bin/sh", "-c", "cd \"$0\" && " + system_.external->build, source_.folder().string()},
        limits);
    while (!process.Poll()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    const ProcessResult& result = process.result();
    WriteFileAtomically(folder / "build.log", result.log);
    if (result.end == ProcessResult::End::kExited && result.code == 0) return "";
    const std::string line = TellingLine(result.log);
    return Describe(result, limits) + (line.empty() ? "" : "; " + line);
  }

  /// Empty where one of the runs left no result.
  std::vector<RunRecord> Drive(const fs::path& folder) const {
    const std::vector<Job> jobs = AllToDo(MakeJobs(Plan(suite_), Fingerprints(),
                                                   {.out = folder,
                                                    .video = false,
                                                    .memory_mib = options_.limits.memory_mib,
                                                    .frames_in_report = "none"}));
    ProgressLine line;
    std::string said;
    const CampaignOutcome outcome =
        RunCampaign(jobs, {.at_once = 1, .limits = options_.limits, .retry = false},
                    {.say = [&](const std::string& text) { said += "\n" + text; },
                     .show = [&](const std::string& text) { line.Show(text); }});
    line.Clear();
    // Our own failure says nothing of the commit.
    if (outcome.failure != 0) throw MachineError("the runs could not be made:" + said);
    std::vector<RunRecord> records;
    for (const Job& job : jobs) {
      if (const auto record = ReadRun(job.spec, folder)) records.push_back(*record);
    }
    if (records.size() < jobs.size()) return {};
    return records;
  }

  const Options& options_;
  const Question question_;
  Suite suite_;
  const SystemSpec system_;
  SourceTree source_;
};

/// The two ends must be what they are said to be: between two good commits there is no bad one.
void CheckEnd(const CommitTrial& trial, CommitState expected, const std::string& name) {
  if (trial.state == expected) return;
  throw InputError(fmt::format("{} is not {} according to this limit: {}", Printable(name),
                               Name(expected), trial.why));
}

int Say(const Options& options, const fs::path& repository, const BisectOutcome& outcome) {
  if (options.json) {
    nlohmann::ordered_json trials = nlohmann::ordered_json::array();
    for (const CommitTrial& trial : outcome.trials) {
      trials.push_back(
          {{"commit", trial.commit}, {"state", Name(trial.state)}, {"why", trial.why}});
    }
    fmt::print("{}", Dump({{"suspects", outcome.suspects}, {"trials", trials}}));
    return kAllPassed;
  }
  fmt::print("\n{}\n", outcome.suspects.size() == 1 ? "the first bad commit:"
                                                    : "one of these is the first bad commit:");
  for (const std::string& commit : outcome.suspects) {
    fmt::print("  {}\n", DescribeCommit(repository, commit));
  }
  fmt::print("runs and build logs: {}\n", options.out);
  return kAllPassed;
}

int RunBisect(const Options& options) {
  const Question question = QuestionFromText(options.limit);
  const std::vector<Suite> suites = LoadInputs({.files = {options.suite}});
  const SystemSpec system = SystemToBuild(suites.front(), options);
  const fs::path repository = system.external->repository;
  const std::vector<std::string> commits = CommitsBetween(repository, options.good, options.bad);
  CheckScenes(suites);
  Trials trials(options, question, suites.front(), system);
  const auto attempt = [&](const std::string& commit) { return trials.Attempt(commit); };
  const CommitTrial good = attempt(FullCommit(repository, options.good));
  CheckEnd(good, CommitState::kGood, options.good);
  const CommitTrial bad = attempt(commits.back());
  CheckEnd(bad, CommitState::kBad, options.bad);
  BisectOutcome outcome = Bisect(commits, attempt);
  outcome.trials.insert(outcome.trials.begin(), {good, bad});
  return Say(options, repository, outcome);
}

}  // namespace

void AddBisectCommand(CLI::App* app, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      app->add_subcommand("bisect", "Find the commit of your own SLAM that first breaks a limit");
  command->add_option("GOOD", options->good, "Commit that keeps the limit")->required();
  command->add_option("BAD", options->bad, "Later commit that breaks it")->required();
  command
      ->add_option("SUITE", options->suite,
                   "Suite file with a system that has 'repository' and 'build'")
      ->required();
  command->add_option("--scene", options->scene, "Scene of the suite to drive")->required();
  command
      ->add_option(
          "--limit", options->limit,
          "Limit on the median over seeds: 'completes', or a bound on a score, for example "
          "'ate_rmse_m<=0.03'")
      ->required();
  AddTwin(command, &options->twin);
  command->add_option("--system", options->system,
                      "System to build; default: the first with 'repository' and 'build'");
  command->add_option("--seed", options->seed, "Seeds to drive, separated by commas; default: 1")
      ->delimiter(',');
  command->add_option("--out", options->out, "Folder for the checkout, the runs and the logs");
  command
      ->add_option("--timeout", options->limits.wall_s,
                   "Most seconds for a build and for a run; default: an hour for a build, as `run` "
                   "for a run")
      ->check(CLI::PositiveNumber);
  AddJson(command, &options->json);
  command->footer(
      "Example: ./aisle bisect v1.3 v1.4 mine.yaml --scene paper/scene2 --limit "
      "'ate_rmse_m<=0.03'");
  command->callback([=] { *action = [=] { return RunBisect(*options); }; });
}

}  // namespace aisle
