#include "harness/campaign/equal_runs.h"

#include "harness/campaign/source.h"
#include "harness/record/copy_run.h"
#include "harness/record/record.h"

namespace aisle {

bool IsOnlyItsInputs(const RunSpec& spec) { return !spec.system.external && spec.repeat == 1; }

bool AreEqual(const Job& a, const Job& b) {
  return IsOnlyItsInputs(a.spec) && IsOnlyItsInputs(b.spec) && a.inputs_hash == b.inputs_hash &&
         a.out == b.out;
}

EqualRuns GroupEqual(const std::vector<Job>& jobs) {
  EqualRuns groups;
  std::map<std::string, std::size_t> first;  // by inputs: which of the driven
  for (const Job& job : jobs) {
    const auto [at, is_new] = first.try_emplace(job.inputs_hash, groups.driven.size());
    if (!is_new && AreEqual(groups.driven[at->second], job)) {
      groups.answered[RunId(groups.driven[at->second].spec)].push_back(job);
    } else {
      groups.driven.push_back(job);
    }
  }
  return groups;
}

bool AnswerFrom(const Job& from, const Job& to) {
  const std::optional<RunRecord> record =
      ReadFinishedRun(from.spec, from.inputs_hash, {}, from.out);
  if (!record || !IsComplete(record->status)) return false;
  WriteJob(to);
  CopyRunAs(from.spec, to.spec, HallOfSource(to.spec.scene_file, to.spec.seed), to.out);
  return true;
}

}  // namespace aisle
