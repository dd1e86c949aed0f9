#include "harness/campaign/campaign.h"

#include <sstream>

#include "harness/campaign/command_files.h"
#include "harness/campaign/equal_runs.h"
#include "harness/campaign/external_run.h"
#include "harness/common/stopwatch.h"
#include "harness/contract/exit_code.h"
#include "harness/io/duration.h"
#include "harness/io/file.h"
#include "harness/io/frame_store.h"
#include "harness/io/input_error.h"
#include "harness/io/places.h"
#include "harness/record/provenance.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

std::string LastLine(const std::string& log) {
  std::istringstream stream(log);
  std::string line, last;
  while (std::getline(stream, line)) {
    if (!line.empty()) last = line;
  }
  return last;
}

/// The record of a run whose process did not live to write one.
RunRecord FailedRun(const Job& job, const ProcessResult& result, const RunLimits& asked) {
  const ProcessLimits limits = ProcessLimitsOf(job, asked);
  RunRecord record;
  record.spec = job.spec;
  record.inputs_hash = job.inputs_hash;
  const bool out_of_bounds =
      result.end == ProcessResult::End::kTimeout || result.end == ProcessResult::End::kMemory;
  record.status = out_of_bounds ? RunStatus::kTimeout : RunStatus::kCrashed;
  if (result.end == ProcessResult::End::kTimeout) record.limit_s = limits.wall_s;
  if (result.end == ProcessResult::End::kMemory) record.limit_mib = limits.memory_mib;
  record.status_why = Describe(result, limits);
  if (const std::string line = TellingLine(result.log); !line.empty()) {
    record.status_why += "; last words: " + line;
  }
  record.last_words = LastWords(result.log);
  record.artifacts["log"] = "runs/" + RunId(job.spec) + "/log.txt";
  record.wall_s = result.wall_s;
  SayWhoMadeIt(&record);
  return record;
}

/// What the campaign left for others of its runs must not fill the disk before it is over.
void ShrinkCaches() {
  constexpr std::uintmax_t kMostBytes = std::uintmax_t{12} << 30;
  ShrinkStore(CacheDir() / "frames", kMostBytes);
  ShrinkStore(CacheDir() / "taught", kMostBytes / 4);
  ShrinkStore(CacheDir() / "datasets", kMostBytes, std::chrono::hours(24));
}

bool IsFailure(const std::optional<RunRecord>& record) {
  return record && !IsComplete(record->status);
}

/// Follows the runs as they come and go.
class Follower {
 public:
  Follower(std::size_t total, const RunLimits& limits, const CampaignEvents& events)
      : total_(total), limits_(limits), events_(events) {}

  void Ended(const Job& job, const ProcessResult& result) {
    ++ended_;
    time_left_.Ended(job);
    ShrinkCaches();
    const std::string id = RunId(job.spec);
    const bool exited = result.end == ProcessResult::End::kExited;
    if (exited && (result.code == kOwnFailure || result.code == kBadInput)) {
      failure_ = std::max(failure_, result.code);
      events_.say(fmt::format("{}: {}", id, Printable(LastLine(result.log), 4096)));
      return;
    }
    const fs::path folder = job.out / "runs" / id;
    RemoveFolder(folder / kGuestFolder);  // what a run that was killed could not take away
    WriteFileAtomically(folder / "log.txt", result.log);
    if (!exited || result.code != 0) {
      WriteFileAtomically(folder / "result.json", ToJson(FailedRun(job, result, limits_)));
    }
    const std::optional<RunRecord> record = ReadRun(job.spec, job.out);
    events_.say(fmt::format("[{}/{}] {}  {}  {}", ended_, total_, id,
                            record ? Name(record->status) : "no result", Duration(result.wall_s)));
  }

  /// These come next, in this order.
  void Begin(const std::vector<Job>& jobs, const ExpectedTimes& expected) {
    time_left_ = TimeLeft(jobs, expected);
    watch_ = {};
  }

  /// `job` was given the answer of its equal.
  void Answered(const Job& job, const Job& equal) {
    ++ended_;
    events_.say(
        fmt::format("[{}/{}] {}  as {}", ended_, total_, RunId(job.spec), RunId(equal.spec)));
  }

  void Tick(const std::vector<JobProgress>& running) {
    std::string text = fmt::format("{}/{} runs", ended_, total_);
    for (const JobProgress& one : running) {
      text += fmt::format(" | {} {}", RunId(one.job->spec), Describe(one.progress));
    }
    if (const auto left_s = time_left_.Seconds(watch_.ElapsedMs() * 1e-3, running)) {
      text += " | " + Duration(*left_s) + " left";
    }
    events_.show(text);
  }

  int failure() const { return failure_; }

 private:
  /// Before the first frame the light that stands still is solved, minutes in a large scene.
  static std::string Describe(const Progress& one) {
    if (one.total == 0) return one.stage.empty() ? "starting" : one.stage;
    return fmt::format("{}/{}", one.done, one.total);
  }

  const std::size_t total_;
  const RunLimits limits_;
  const CampaignEvents& events_;
  std::size_t ended_ = 0;
  int failure_ = 0;
  TimeLeft time_left_{{}, {}};
  Stopwatch watch_;
};

/// Drives all of `jobs`; false when interrupted.
bool DriveAll(const std::vector<Job>& jobs, const CampaignOptions& options, Follower* follower,
              const std::function<void(const Job&)>& ended) {
  for (const Job& job : jobs) WriteJob(job);
  follower->Begin(jobs, options.expected);
  const auto argv = [](const Job& job) -> std::vector<std::string> {
    return {OwnExecutable().string(), "run-one", JobPath(job.out, job.spec).string()};
  };
  return RunJobs(
      jobs, {.jobs = options.at_once, .limits = options.limits, .interrupted = options.interrupted},
      {.argv = argv,
       .ended =
           [&](const Job& job, const ProcessResult& result) {
             follower->Ended(job, result);
             ended(job);
           },
       .tick = [&](const std::vector<JobProgress>& running,
                   std::size_t) { follower->Tick(running); }});
}

/// Makes all of `jobs`, equal ones by one drive; false when interrupted. A drive that fails answers
/// for itself alone: its equals are driven after all.
bool RunAll(const std::vector<Job>& jobs, const CampaignOptions& options,
            const CampaignEvents& events, int* failure) {
  Follower follower(jobs.size(), options.limits, events);
  const EqualRuns runs = GroupEqual(jobs);
  std::vector<Job> unanswered;
  const auto answer = [&](const Job& driven) {
    const auto equals = runs.answered.find(RunId(driven.spec));
    if (equals == runs.answered.end()) return;
    for (const Job& equal : equals->second) {
      if (AnswerFrom(driven, equal)) {
        follower.Answered(equal, driven);
      } else {
        unanswered.push_back(equal);
      }
    }
  };
  const bool finished =
      DriveAll(LongestFirst(runs.driven, options.expected), options, &follower, answer) &&
      DriveAll(unanswered, options, &follower, [](const Job&) {});
  *failure = std::max(*failure, follower.failure());
  return finished;
}

/// Those that failed and were not tried a second time.
std::vector<Job> TriedOnce(const std::vector<Job>& jobs) {
  std::vector<Job> once;
  for (const Job& job : jobs) {
    const std::optional<RunRecord> record = ReadRun(job.spec, job.out);
    if (IsFailure(record) && record->attempts < 2) once.push_back(job);
  }
  return once;
}

/// The same runs in another folder, in which nothing of them lies.
std::vector<Job> OnceMore(std::vector<Job> jobs) {
  for (Job& job : jobs) job.out /= "again";
  return AllToDo(jobs);
}

/// Files with the first attempts what became of the second ones: where one did not fail, the run is
/// flaky. An attempt that left no result was none.
void FileSecondAttempts(const std::vector<Job>& jobs) {
  for (const Job& job : jobs) {
    const std::optional<RunRecord> second = ReadRun(job.spec, job.out / "again");
    std::optional<RunRecord> first = ReadRun(job.spec, job.out);
    if (!second || !first) continue;
    first->attempts = 2;
    if (IsComplete(second->status)) {
      first->flaky = true;
      first->status_why += "; a second attempt with the same inputs ended " + Name(second->status);
    }
    WriteFileAtomically(job.out / "runs" / RunId(job.spec) / "result.json", ToJson(*first));
  }
}

}  // namespace

CampaignOutcome RunCampaign(const std::vector<Job>& jobs, const CampaignOptions& options,
                            const CampaignEvents& events) {
  const Stopwatch watch;
  CampaignOutcome outcome;
  outcome.finished = RunAll(jobs, options, events, &outcome.failure);
  if (outcome.finished && options.retry) {
    std::vector<Job> failed = TriedOnce(jobs);
    const std::vector<Job> before = TriedOnce(options.kept);
    failed.insert(failed.end(), before.begin(), before.end());
    if (!failed.empty()) {
      events.say(
          fmt::format("aisle: {} failed; running again to tell flaky from broken", failed.size()));
      int second_failure = 0;  // the first attempt is what counts
      outcome.finished = RunAll(OnceMore(failed), options, events, &second_failure);
      FileSecondAttempts(failed);
    }
  }
  outcome.wall_s = watch.ElapsedMs() * 1e-3;
  return outcome;
}

std::optional<RunRecord> ResultThatStands(const RunSpec& spec, const std::string& inputs_hash,
                                          const RunLimits& limits,
                                          const std::filesystem::path& out) {
  const auto& external = spec.system.external;
  if (external && MayChangeUnseen(*external)) return std::nullopt;
  return ReadFinishedRun(spec, inputs_hash, limits, out);
}

Standing StandingOf(const std::vector<Job>& jobs, const RunLimits& limits) {
  Standing standing;
  std::map<std::string, Job> good;  // by inputs
  std::vector<Job> left;
  for (const Job& job : jobs) {
    const std::optional<RunRecord> result =
        ResultThatStands(job.spec, job.inputs_hash, limits, job.out);
    if (result && IsComplete(result->status)) good.try_emplace(job.inputs_hash, job);
    (result ? standing.kept : left).push_back(job);
  }
  for (const Job& job : left) {
    const auto equal = good.find(job.inputs_hash);
    if (equal != good.end() && AreEqual(equal->second, job)) {
      standing.answered.emplace_back(job, equal->second);
    } else {
      standing.todo.push_back(job);
    }
  }
  return standing;
}

Standing Resume(const std::vector<Job>& jobs, const RunLimits& limits) {
  Standing standing = StandingOf(jobs, limits);
  AllToDo(standing.todo);
  std::erase_if(standing.answered, [&](const auto& pair) {
    const auto& [job, equal] = pair;
    RemoveFolder(job.out / "runs" / RunId(job.spec));
    const bool filed = AnswerFrom(equal, job);
    if (!filed) standing.todo.push_back(job);
    return !filed;
  });
  return standing;
}

std::vector<Job> AllToDo(const std::vector<Job>& jobs) {
  for (const Job& job : jobs) RemoveFolder(job.out / "runs" / RunId(job.spec));
  return jobs;
}

}  // namespace aisle
