#include "harness/cli/publish.h"

#include "harness/cli/command.h"
#include "harness/cli/terminal.h"
#include "harness/io/file.h"
#include "harness/judge/limit.h"
#include "harness/record/history.h"
#include "harness/report/console.h"
#include "harness/report/page/page.h"
#include "harness/report/page/trends.h"
#include "harness/report/report.h"

namespace aisle {
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
