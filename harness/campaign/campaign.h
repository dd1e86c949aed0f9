#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/campaign/schedule.h"
#include "harness/record/record.h"

namespace aisle {

/// Where a campaign tells its user how it goes.
struct CampaignEvents {
  std::function<void(const std::string&)> say;   ///< a line that stays
  std::function<void(const std::string&)> show;  ///< a line that the next one replaces
};

struct CampaignOptions {
  int at_once = 1;  ///< processes
  RunLimits limits;
  bool retry = true;  ///< try failed runs once more, to tell flaky from broken
  /// Runs of the same night that are there already: their failures are tried once more too, where
  /// that has not been done.
  std::vector<Job> kept = {};
  ExpectedTimes expected = {};                     ///< what runs are thought to take
  const std::atomic<bool>* interrupted = nullptr;  ///< set from outside: stop soon
};

struct CampaignOutcome {
  bool finished = true;  ///< false: interrupted
  int failure = 0;       ///< 0, or the exit code of what failed on our side
  double wall_s = 0;
};

/// Makes the runs, each in a process of its own that reads its job.json, and files the failures of
/// those that could not do it themselves. Of runs of equal inputs one is driven, and its answer is
/// filed for the others. Runs that failed are then made once more, elsewhere: the same inputs that
/// do not fail the second time make the run flaky, never good.
CampaignOutcome RunCampaign(const std::vector<Job>& jobs, const CampaignOptions& options,
                            const CampaignEvents& events);

/// How a folder stands before its night goes on.
struct Standing {
  std::vector<Job> kept = {};  ///< have a result for these very inputs within these limits
  /// Have none, but an equal that is kept has: the job, and whose result answers for it.
  std::vector<std::pair<Job, Job>> answered = {};
  std::vector<Job> todo = {};

  std::size_t there() const { return kept.size() + answered.size(); }
};

/// The result of a run where nothing says that it would be another now: its inputs are these, and
/// somebody can tell what its command runs.
std::optional<RunRecord> ResultThatStands(const RunSpec& spec, const std::string& inputs_hash,
                                          const RunLimits& limits,
                                          const std::filesystem::path& out);

/// Looks and changes nothing.
Standing StandingOf(const std::vector<Job>& jobs, const RunLimits& limits);

/// The same, and files the answers of equals; what else lies in the folders of the jobs to do is
/// taken away.
Standing Resume(const std::vector<Job>& jobs, const RunLimits& limits);

/// All of them, once what lies in their folders is taken away.
std::vector<Job> AllToDo(const std::vector<Job>& jobs);

}  // namespace aisle
