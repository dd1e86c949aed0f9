#include "harness/cli/evening.h"

#include <sstream>

#include "harness/cli/command.h"
#include "harness/cli/places.h"
#include "harness/io/file.h"
#include "harness/io/frame_store.h"
#include "harness/io/input_error.h"
#include "harness/record/record.h"

namespace aisle {
namespace {

std::string LastLine(const std::string& log) {
  std::istringstream stream(log);
  std::string line, last;
  while (std::getline(stream, line)) {
    if (!line.empty()) last = line;
  }
  return last;
}

/// The record of a run whose process did not live to write one.
RunRecord FailedRun(const Job& job, const ProcessResult& result, const ProcessLimits& limits) {
  RunRecord record;
  record.spec = job.spec;
  record.inputs_hash = job.inputs_hash;
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

/// What the evening left for others of its runs must not fill the disk before it is over.
void ShrinkCaches() {
  constexpr std::uintmax_t kMostBytes = std::uintmax_t{12} << 30;
  ShrinkStore(CacheDir() / "frames", kMostBytes);
  ShrinkStore(CacheDir() / "datasets", kMostBytes, std::chrono::hours(24));
}

}  // namespace

void Evening::Ended(const Job& job, const ProcessResult& result) {
  ++ended_;
  ShrinkCaches();
  const std::string id = RunId(job.spec);
  const bool exited = result.end == ProcessResult::End::kExited;
  if (exited && (result.code == kOwnFailure || result.code == kBadInput)) {
    failure_ = std::max(failure_, result.code);
    Say(fmt::format("{}: {}", id, Printable(LastLine(result.log), 4096)));
    return;
  }
  WriteFileAtomically(out_ / "runs" / id / "log.txt", result.log);
  if (!exited || result.code != 0) {
    const RunRecord record = FailedRun(job, result, limits_);
    WriteFileAtomically(out_ / "runs" / id / "result.json", ToJson(record));
  }
  const std::optional<RunRecord> record = ReadRun(job.spec, out_);
  Say(fmt::format("[{}/{}] {}  {}  {}", ended_, total_, id,
                  record ? Name(record->status) : "no result", Duration(result.wall_s)));
}

void Evening::Tick(const std::vector<JobProgress>& running) {
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

bool Evening::Run(const std::vector<Job>& jobs, int at_once, const std::atomic<bool>& interrupted) {
  return RunJobs(
      jobs, {.jobs = at_once, .limits = limits_, .interrupted = &interrupted},
      {.ended = [&](const Job& job, const ProcessResult& result) { Ended(job, result); },
       .tick = [&](const std::vector<JobProgress>& running, std::size_t) { Tick(running); }});
}

void Evening::Say(const std::string& text) {
  line_.Clear();
  fmt::print(stderr, "{}\n", text);
}

}  // namespace aisle
