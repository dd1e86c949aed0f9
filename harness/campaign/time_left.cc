#include "harness/campaign/time_left.h"

#include <algorithm>
#include <set>

#include "harness/record/record.h"

namespace aisle {

TimeLeft::TimeLeft(const std::vector<Job>& jobs, const ExpectedTimes& expected) {
  std::set<std::string> rendered;
  std::vector<std::string> unknown;
  for (const Job& job : jobs) {
    const std::string id = RunId(job.spec);
    const auto time = expected.find(id);
    if (time == expected.end()) {
      unknown.push_back(id);
      continue;
    }
    const bool is_first = rendered.insert(job.frames_key).second;
    work_s_[id] = time->second.drive_s + (is_first ? time->second.render_s : 0);
    total_s_ += work_s_[id];
  }
  const double mean_s = work_s_.empty() ? 1 : total_s_ / static_cast<double>(work_s_.size());
  for (const std::string& id : unknown) {
    work_s_[id] = mean_s;
    total_s_ += mean_s;
  }
}

void TimeLeft::Ended(const Job& job) { done_s_ += WorkOf(job); }

std::optional<double> TimeLeft::Seconds(double elapsed_s,
                                        const std::vector<JobProgress>& running) const {
  constexpr double kTelling = 0.002;  // of all work
  double done_s = done_s_;
  for (const JobProgress& one : running) {
    const auto& [done, total, stage] = one.progress;
    if (total > 0) done_s += WorkOf(*one.job) * done / total;
  }
  if (done_s <= 0 || done_s < kTelling * total_s_) return std::nullopt;
  return elapsed_s * std::max(total_s_ - done_s, 0.0) / done_s;
}

double TimeLeft::WorkOf(const Job& job) const {
  const auto work_s = work_s_.find(RunId(job.spec));
  return work_s == work_s_.end() ? 0 : work_s->second;
}

}  // namespace aisle
