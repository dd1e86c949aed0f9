#include "harness/cli/collect.h"

#include "harness/cli/command.h"
#include "harness/cli/places.h"
#include "harness/cli/terminal.h"
#include "harness/io/file.h"
#include "harness/judge/limit.h"
#include "harness/judge/twins.h"
#include "harness/record/history.h"
#include "harness/report/console.h"
#include "harness/report/page/page.h"
#include "harness/report/page/trends.h"
#include "harness/report/report.h"

namespace aisle {

Results Collect(const Suite& suite, const std::vector<RunSpec>& specs,
                const std::filesystem::path& out, const CollectOptions& options) {
  Results results;
  results.provenance = OwnProvenance();
  results.suite = suite.name;
  results.question = suite.question;
  std::vector<Verdict> missing;
  for (const RunSpec& spec : specs) {
    if (std::optional<RunRecord> record = ReadRun(spec, out)) {
      results.runs.push_back(*std::move(record));
    } else {
      missing.push_back({.name = RunId(spec) + ": completes",
                         .passed = false,
                         .flaky = false,
                         .value = {},
                         .limit = {},
                         .why = "no result",
                         .scene = spec.scene,
                         .twin = spec.twin,
                         .system = spec.system});
    }
  }
  AddDynamicPenalty(&results.runs);
  results.verdicts =
      Judge(results.runs, options.judge_limits ? suite.limits : std::vector<Limit>{});
  results.verdicts.insert(results.verdicts.begin(), missing.begin(), missing.end());
  return results;
}

namespace {

/// The nights of one suite share a file beside their folders.
void Remember(const Results& results, const std::filesystem::path& out) {
  const std::filesystem::path history =
      std::filesystem::absolute(out).lexically_normal().parent_path() / "history.sqlite";
  AppendToHistory(history, results);
  const std::string trends = TrendSection(ReadHistory(history, results.suite));
  if (trends.empty()) return;
  WriteFileAtomically(out / "trends.html",
                      Page("Trends of " + results.suite, "",
                           "<p><a href=\"index.html\">back to the verdict</a></p>\n" + trends));
}

}  // namespace

int Publish(const Results& results, const std::filesystem::path& out,
            const PublishOptions& options) {
  if (options.remember) Remember(results, out);
  WriteReport(results, out);
  if (options.json) {
    fmt::print("{}", ToJson(results));
  } else {
    fmt::print("{}", ToConsole(results, StdoutHasColor()));
    fmt::print("report: {}\nagain:  {}\n", (out / "index.html").string(), results.rerun);
  }
  if (options.failure != 0) return options.failure;
  return AllPassed(results) ? kAllPassed : kVerdictFailed;
}

}  // namespace aisle
