#include "harness/campaign/schedule.h"

#include <algorithm>
#include <chrono>
#include <list>
#include <memory>
#include <thread>

#include "harness/io/input_error.h"
#include "harness/record/record.h"

namespace aisle {
namespace {

constexpr auto kPollInterval = std::chrono::milliseconds(50);

struct Running {
  const Job* job;
  std::unique_ptr<Process> process;
};

/// Whether it leaves anything that another job could take instead of making it.
bool Keeps(const Job& job) {
  return !job.frames.empty() || !job.led_frames.empty() || !job.dataset.empty();
}

/// The next job that may start: none whose frames are being made for it right now.
std::list<const Job*>::iterator NextToStart(std::list<const Job*>& waiting,
                                            const std::set<std::string>& made,
                                            const std::list<Running>& running) {
  return std::find_if(waiting.begin(), waiting.end(), [&](const Job* job) {
    return !Keeps(*job) || made.count(job->frames_key) > 0 ||
           std::none_of(running.begin(), running.end(), [&](const Running& other) {
             return Keeps(*other.job) && other.job->frames_key == job->frames_key;
           });
  });
}

/// Starts the job's process. False where the machine has no room for another one beside those that
/// run; throws MachineError where it has none at all.
bool Start(const Job& job, const RunLimits& limits, const ScheduleEvents& events,
           std::list<Running>* running) {
  try {
    running->push_back(
        {&job, std::make_unique<Process>(events.argv(job), ProcessLimitsOf(job, limits))});
    return true;
  } catch (const MachineError&) {
    if (running->empty()) throw;
    return false;
  }
}

std::vector<JobProgress> ProgressOf(const std::list<Running>& running) {
  std::vector<JobProgress> progress;
  for (const Running& one : running) {
    progress.push_back({one.job, one.process->progress()});
  }
  return progress;
}

}  // namespace

std::vector<Job> LongestFirst(const std::vector<Job>& jobs, const ExpectedTimes& expected) {
  struct Group {
    double drive_s = 0, render_s = 0;
    std::vector<std::pair<double, const Job*>> jobs;
  };
  std::vector<Group> groups;
  std::map<std::string, std::size_t> index;  // by frames
  for (const Job& job : jobs) {
    const auto [at, is_new] = index.try_emplace(job.frames_key, groups.size());
    if (is_new) groups.emplace_back();
    Group& group = groups[at->second];
    const auto known = expected.find(RunId(job.spec));
    const ExpectedTime time = known == expected.end() ? ExpectedTime{} : known->second;
    group.drive_s += time.drive_s;
    group.render_s = std::max(group.render_s, time.render_s);
    group.jobs.emplace_back(time.drive_s, &job);
  }
  std::ranges::stable_sort(groups, std::greater(),
                           [](const Group& group) { return group.drive_s + group.render_s; });
  std::vector<Job> ordered;
  for (Group& group : groups) {
    std::ranges::stable_sort(group.jobs, std::greater(), &std::pair<double, const Job*>::first);
    for (const auto& [job_s, job] : group.jobs) ordered.push_back(*job);
  }
  return ordered;
}

ProcessLimits ProcessLimitsOf(const Job& job, const RunLimits& limits) {
  return {.wall_s = WallLimit_s(limits, job.spec.system), .memory_mib = limits.memory_mib};
}

bool RunJobs(const std::vector<Job>& jobs, const ScheduleOptions& options,
             const ScheduleEvents& events) {
  std::list<const Job*> waiting;
  for (const Job& job : jobs) waiting.push_back(&job);
  std::list<Running> running;
  std::set<std::string> made;  // frames that a finished job has left for the others
  std::size_t ended = 0;
  while (!waiting.empty() || !running.empty()) {
    if (options.interrupted != nullptr && options.interrupted->load()) return false;
    while (static_cast<int>(running.size()) < std::max(options.jobs, 1)) {
      const auto next = NextToStart(waiting, made, running);
      if (next == waiting.end() || !Start(**next, options.limits, events, &running)) break;
      waiting.erase(next);
    }
    for (auto it = running.begin(); it != running.end();) {
      if (!it->process->Poll()) {
        ++it;
        continue;
      }
      ++ended;
      const ProcessResult& result = it->process->result();
      if (result.end == ProcessResult::End::kExited && result.code == 0) {
        made.insert(it->job->frames_key);
      }
      if (events.ended) events.ended(*it->job, result);
      it = running.erase(it);
    }
    if (events.tick) events.tick(ProgressOf(running), ended);
    if (!running.empty()) std::this_thread::sleep_for(kPollInterval);
  }
  return true;
}

}  // namespace aisle
