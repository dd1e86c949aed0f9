#include "harness/cli/publish.h"

#include "harness/cli/command.h"
#include "harness/cli/night_folder.h"
#include "harness/cli/terminal.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/judge/limit.h"
#include "harness/plugs/systems.h"
#include "harness/record/history.h"
#include "harness/report/allure.h"
#include "harness/report/console.h"
#include "harness/report/report.h"

namespace aisle {
namespace {

/// The nights of one suite share a file beside their folders. What is in the way is said, and costs
/// the night its place among the trends alone. Returns it; empty where all is well.
std::string TryToRemember(const Results& results, const std::filesystem::path& out) {
  const std::string replaced = NightReplaced(HistoryPath(out), results, out);
  if (!replaced.empty()) fmt::print(stderr, "aisle: warning: {}\n", replaced);
  try {
    AppendToHistory(HistoryPath(out), results, out);
    return "";
  } catch (const MachineError& trouble) {
    fmt::print(stderr, "aisle: the trends will not include this run: {}\n", trouble.what());
    return trouble.what();
  }
}

}  // namespace

std::filesystem::path HistoryPath(const std::filesystem::path& out) {
  std::filesystem::path folder = std::filesystem::absolute(out).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();  // "night/" and "." name a folder too
  return folder.parent_path() / "history.sqlite";
}

void RemoveReport(const std::filesystem::path& out) {
  for (const char* file : {"results.json", "junit.xml", "summary.txt", "summary.csv", "index.html",
                           "tables.md", "tables.tex"}) {
    std::error_code error;
    std::filesystem::remove(out / file, error);
    if (error) throw MachineError(fmt::format("{}: {}", (out / file).string(), error.message()));
  }
}

ReportOptions AboutNight(const std::filesystem::path& out) {
  ReportOptions options;
  for (const System& system : Systems()) options.systems[system.name] = system.description;
  if (const std::optional<PlanFile> plan = FindPlan(out)) {
    for (const Suite& suite : plan->suites) options.limits += suite.limits.size();
  }
  return options;
}

ReportOptions WithHistory(const Results& results, const std::filesystem::path& out) {
  ReportOptions options = AboutNight(out);
  options.history_file = HistoryPath(out);
  try {
    options.history = ReadHistory(options.history_file, results.suite);
  } catch (const MachineError& trouble) {
    options.history_trouble = trouble.what();
    return options;
  }
  // The page of a night knows nothing of later ones.
  std::erase_if(options.history,
                [&](const TrendPoint& point) { return point.started > results.started; });
  const bool filed = !options.history.empty() && options.history.back().started == results.started;
  if (!filed) options.history.clear();
  return options;
}

int Publish(const Results& results, const std::filesystem::path& out,
            const PublishOptions& options) {
  const std::string trouble = options.remember ? TryToRemember(results, out) : "";
  ReportOptions about =
      options.remember && trouble.empty() ? WithHistory(results, out) : AboutNight(out);
  if (!trouble.empty()) about.history_trouble = trouble;
  WriteReport(results, out, about);
  if (!options.allure.empty()) WriteAllure(results, out, options.allure);
  if (options.json) {
    fmt::print("{}", ToJson(results));
  } else {
    fmt::print("{}", ToConsole(results, LookOfStdout()));
    fmt::print("report: {}\nagain:  {}\n", (out / "index.html").string(), results.rerun);
  }
  if (options.failure != 0) return options.failure;
  if (!AllPassed(results)) return kVerdictFailed;
  return trouble.empty() ? kAllPassed : kOwnFailure;
}

}  // namespace aisle
