#include "harness/campaign/campaign.h"

#include <iterator>
#include <set>
#include <sstream>
#include <tuple>

#include "harness/campaign/cache_bounds.h"
#include "harness/campaign/command_files.h"
#include "harness/campaign/equal_runs.h"
#include "harness/campaign/external_run.h"
#include "harness/campaign/folder_modes.h"
#include "harness/campaign/source.h"
#include "harness/common/stopwatch.h"
#include "harness/contract/exit_code.h"
#include "harness/io/duration.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/io/places.h"
#include "harness/record/provenance.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

/// Where a run and what comes of it lies.
fs::path FolderOf(const Job& job) { return job.out / "runs" / RunId(job.spec); }

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

bool IsFailure(const std::optional<RunRecord>& record) {
  return record && !IsComplete(record->status);
}

/// What a night and its runs read and write, and a system of others could lock them out of; nothing
/// where there is no such system.
std::vector<fs::path> PlacesOf(const std::vector<Job>& jobs) {
  const auto is_foreign = [](const Job& job) { return job.spec.system.external.has_value(); };
  if (std::ranges::none_of(jobs, is_foreign)) return {};
  const fs::path cache = CacheDir();
  std::set<fs::path> places{cache / "frames", cache / "taught", cache / "datasets"};
  std::set<std::string> scenes;
  for (const Job& job : jobs) {
    places.insert({job.out, job.out / "runs", FolderOf(job), job.frames, job.led_frames,
                   job.teaching, job.dataset});
    places.insert(job.hidden.begin(), job.hidden.end());
    if (!scenes.insert(job.spec.scene_file).second) continue;
    try {
      for (const std::string& file : FilesOfSource(job.spec.scene_file)) places.insert(file);
    } catch (const InputError&) {  // its runs will say so, each for itself
    }
  }
  places.erase("");
  return {places.begin(), places.end()};
}

/// Modes of all that a night needs, put back now and then: a look at thousands of runs takes a
/// while.
class ModesOfNight {
 public:
  /// Once their folders are there.
  void Add(const std::vector<Job>& jobs) { modes_.Add(PlacesOf(jobs)); }
  void Tick() {
    constexpr double kEvery_ms = 250;
    if (since_.ElapsedMs() > kEvery_ms) PutBack();
  }
  void PutBack() {
    modes_.PutBack();
    since_ = {};
  }

 private:
  FolderModes modes_;
  Stopwatch since_;
};

/// Follows the runs as they come and go.
class Follower {
 public:
  Follower(std::size_t total, const RunLimits& limits, const CampaignEvents& events,
           ModesOfNight* modes)
      : total_(total), limits_(limits), events_(events), modes_(*modes) {}

  void Ended(const Job& job, const ProcessResult& result) {
    modes_.PutBack();
    ++ended_;
    time_left_.Ended(job);
    caches_.Tick();
    const std::string id = RunId(job.spec);
    const bool exited = result.end == ProcessResult::End::kExited;
    if (exited && (result.code == kOwnFailure || result.code == kBadInput)) {
      failure_ = std::max(failure_, result.code);
      events_.say(fmt::format("{}: {}", id, Printable(LastLine(result.log), 4096)));
      return;
    }
    const fs::path folder = FolderOf(job);
    // What a run that was killed could not take away; who needs the place finds what stays.
    std::ignore = TryToRemoveFolder(folder / kGuestFolder);
    WriteFileAtomically(folder / "log.txt", result.log);
    if (!exited || result.code != 0) {
      WriteFileAtomically(folder / "result.json", ToJson(FailedRun(job, result, limits_)));
    }
    const std::optional<RunRecord> record = ReadRun(job.spec, job.out);
    events_.say(fmt::format("[{}/{}] {}  {}  {}", ended_, total_, id,
                            record ? Name(record->status) : "no result", Duration(result.wall_s)));
  }

  /// These come next, in this order. Their folders are there.
  void Begin(const std::vector<Job>& jobs, const ExpectedTimes& expected) {
    modes_.Add(jobs);
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
    modes_.Tick();
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
  ModesOfNight& modes_;
  std::size_t ended_ = 0;
  int failure_ = 0;
  TimeLeft time_left_{{}, {}};
  Stopwatch watch_;
  /// What the runs leave for each other must not fill the disk before all are over.
  CacheBounds caches_{CacheDir(), [watch = Stopwatch()] { return watch.ElapsedMs(); }};
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
            const CampaignEvents& events, ModesOfNight* modes, int* failure) {
  Follower follower(jobs.size(), options.limits, events, modes);
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

/// The same run in another folder.
Job OnceMore(Job job) {
  job.out /= "again";
  return job;
}

/// Takes out those that cannot be tried again since something of an earlier night keeps the place.
void DropWithoutPlace(std::vector<Job>* failed, const CampaignEvents& events) {
  std::erase_if(*failed, [&](const Job& job) {
    const fs::path place = FolderOf(OnceMore(job));
    if (TryToRemoveFolder(place)) return false;
    events.say(fmt::format("{}: not run again: cannot empty {}", RunId(job.spec), place.string()));
    return true;
  });
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
    WriteFileAtomically(FolderOf(job) / "result.json", ToJson(*first));
  }
}

}  // namespace

CampaignOutcome RunCampaign(const std::vector<Job>& jobs, const CampaignOptions& options,
                            const CampaignEvents& events) {
  const Stopwatch watch;
  CampaignOutcome outcome;
  ModesOfNight modes;  // of first attempts too while the second ones run
  modes.Add(options.kept);
  outcome.finished = RunAll(jobs, options, events, &modes, &outcome.failure);
  if (outcome.finished && options.retry) {
    std::vector<Job> failed = TriedOnce(jobs);
    const std::vector<Job> before = TriedOnce(options.kept);
    failed.insert(failed.end(), before.begin(), before.end());
    DropWithoutPlace(&failed, events);
    if (!failed.empty()) {
      events.say(
          fmt::format("aisle: {} failed; running again to tell flaky from broken", failed.size()));
      int second_failure = 0;  // the first attempt is what counts
      std::vector<Job> again;
      std::ranges::transform(failed, std::back_inserter(again), OnceMore);
      outcome.finished = RunAll(again, options, events, &modes, &second_failure);
      FileSecondAttempts(failed);
    }
  }
  ShrinkCaches(CacheDir());
  outcome.wall_s = watch.ElapsedMs() * 1e-3;
  return outcome;
}

std::optional<RunRecord> ResultThatStands(const RunSpec& spec, const std::string& inputs_hash,
                                          const RunLimits& limits,
                                          const std::filesystem::path& out) {
  const auto& external = spec.system.external;
  if (external && !WhyUnseen(*external).empty()) return std::nullopt;
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
    RemoveFolder(FolderOf(job));
    const bool filed = AnswerFrom(equal, job);
    if (!filed) standing.todo.push_back(job);
    return !filed;
  });
  return standing;
}

std::vector<Job> AllToDo(const std::vector<Job>& jobs) {
  for (const Job& job : jobs) RemoveFolder(FolderOf(job));
  return jobs;
}

}  // namespace aisle
