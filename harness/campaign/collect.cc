#include "harness/campaign/collect.h"

#include "harness/judge/limit.h"
#include "harness/judge/twins.h"
#include "harness/record/provenance.h"
#include "harness/record/record.h"

namespace aisle {
namespace {

Verdict Missing(const RunSpec& spec) {
  return {.name = RunId(spec) + ": completes",
          .passed = false,
          .flaky = false,
          .value = {},
          .limit = {},
          .why = "no result",
          .scene = spec.scene,
          .twin = spec.twin,
          .system = spec.system.name};
}

void Append(const std::vector<Verdict>& more, std::vector<Verdict>* verdicts) {
  verdicts->insert(verdicts->end(), more.begin(), more.end());
}

/// The limits of each suite, held against the runs of that suite alone.
std::vector<Verdict> JudgeSuites(const std::vector<Suite>& suites,
                                 const std::vector<RunRecord>& runs) {
  std::vector<Verdict> verdicts;
  for (const Suite& suite : suites) {
    std::set<std::string> cells;
    for (const RunSpec& spec : Plan(suite)) cells.insert(RunId(spec));
    std::vector<RunRecord> own;
    for (const RunRecord& run : runs) {
      if (cells.contains(RunId(run.spec))) own.push_back(run);
    }
    Append(JudgeLimits(own, suite.limits), &verdicts);
  }
  return verdicts;
}

}  // namespace

Results Collect(const PlanFile& plan, const std::vector<RunSpec>& specs,
                const std::filesystem::path& out, const CollectOptions& options) {
  Results results;
  results.suite = plan.name();
  results.question = plan.question();
  results.suite_file = plan.suite_file;
  for (const RunSpec& spec : specs) {
    if (std::optional<RunRecord> record = ReadRun(spec, out)) {
      results.runs.push_back(*std::move(record));
    } else {
      results.verdicts.push_back(Missing(spec));
    }
  }
  results.provenance = ProvenanceOf(results.runs);
  AddDynamicPenalty(&results.runs);
  Append(JudgeRuns(results.runs), &results.verdicts);
  if (options.judge_limits) Append(JudgeSuites(plan.suites, results.runs), &results.verdicts);
  return results;
}

}  // namespace aisle
