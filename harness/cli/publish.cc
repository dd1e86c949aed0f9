#include "harness/cli/publish.h"

#include "harness/cli/command.h"
#include "harness/cli/terminal.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
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
  const std::filesystem::path history = HistoryPath(out);
  AppendToHistory(history, results);
  const std::string trends = TrendSection(ReadHistory(history, results.suite));
  if (trends.empty()) return;
  WriteFileAtomically(out / "trends.html",
                      Page("Trends of " + results.suite, "",
                           "<p><a href=\"index.html\">back to the verdict</a></p>\n" + trends));
}

/// The same; what is in the way is said, and costs the night its place among the trends alone.
bool TryToRemember(const Results& results, const std::filesystem::path& out) {
  try {
    Remember(results, out);
    return true;
  } catch (const MachineError& trouble) {
    fmt::print(stderr, "aisle: the trends are without this night: {}\n", trouble.what());
    return false;
  }
}

}  // namespace

std::filesystem::path HistoryPath(const std::filesystem::path& out) {
  return std::filesystem::absolute(out).lexically_normal().parent_path() / "history.sqlite";
}

int Publish(const Results& results, const std::filesystem::path& out,
            const PublishOptions& options) {
  const bool remembered = !options.remember || TryToRemember(results, out);
  WriteReport(results, out);
  if (options.json) {
    fmt::print("{}", ToJson(results));
  } else {
    fmt::print("{}", ToConsole(results, StdoutHasColor()));
    fmt::print("report: {}\nagain:  {}\n", (out / "index.html").string(), results.rerun);
  }
  if (options.failure != 0) return options.failure;
  if (!AllPassed(results)) return kVerdictFailed;
  return remembered ? kAllPassed : kOwnFailure;
}

}  // namespace aisle
