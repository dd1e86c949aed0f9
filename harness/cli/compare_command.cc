#include "harness/cli/command.h"
#include "harness/cli/common_options.h"
#include "harness/cli/terminal.h"
#include "harness/common/first_of_many.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/io/places.h"
#include "harness/judge/change_size.h"
#include "harness/judge/compare.h"
#include "harness/judge/gate.h"
#include "harness/judge/missing.h"
#include "harness/record/provenance.h"
#include "harness/record/record_json.h"
#include "harness/record/units.h"
#include "harness/report/compare_text.h"
#include "harness/report/page/compare_page.h"
#include "harness/report/page/page.h"
#include "harness/report/page/resources.h"
#include "harness/report/report.h"
#include "harness/suite/plan.h"

namespace aisle {
namespace {

struct Options {
  std::string before, after, out;
  CompareOptions compare;
  bool json = false;
};

/// A report's folder, or a results file such as a baseline.
Results ReadEither(const std::string& path) {
  Results results = std::filesystem::is_directory(path) ? ReadResults(path)
                                                        : ResultsFromJson(ReadFile(path), path);
  CheckUnits(results, path);
  return results;
}

ComparedNight NightOf(const std::string& path, const Results& results) {
  return {.name = path,
          .results = &results,
          .folder = std::filesystem::is_directory(path) ? std::filesystem::path(path)
                                                        : std::filesystem::path()};
}

void WritePages(const std::vector<Comparison>& comparisons, const std::vector<MissingRuns>& missing,
                const ComparedNight& before, const ComparedNight& after,
                const std::filesystem::path& out) {
  WriteResources(out);
  WriteFileAtomically(out / "compare.md", ToMarkdown(comparisons, missing));
  WriteFileAtomically(out / "compare.json", ToJson(comparisons, missing));
  WriteFileAtomically(out / "compare.html",
                      Page(fmt::format("What changed from {} to {}", before.name, after.name), "",
                           ComparePage(comparisons, before, after, out)));
  fmt::print(stderr, "report: {}\n", (out / "compare.html").string());  // JSON has stdout
}

int CompareReports(const Options& options) {
  const Results before = ReadEither(options.before);
  const Results after = ReadEither(options.after);
  std::vector<Comparison> comparisons = Compare(before, after, options.compare);
  LargestFirst(&comparisons);
  const std::vector<MissingRuns> missing = MissingRunsOf(before, after);
  fmt::print("{}", options.json ? ToJson(comparisons, missing)
                                : ToConsole(comparisons, missing, LookOfStdout()));
  if (!options.out.empty()) {
    WritePages(comparisons, missing, NightOf(options.before, before), NightOf(options.after, after),
               options.out);
  }
  if (comparisons.empty()) {
    const std::string why = WhyNothingShared(before, after);
    fmt::print(stderr, "aisle: nothing to compare: {}\n",
               why.empty() ? "the reports have no scores in common" : why);
    // Of nights that share a cell, one without scores hides nothing of what else has vanished.
    return why.empty() && !missing.empty() ? kVerdictFailed : kNothingToDo;
  }
  const bool worse = std::any_of(comparisons.begin(), comparisons.end(),
                                 [](const Comparison& c) { return IsAlarm(c.change); });
  return worse || !missing.empty() ? kVerdictFailed : kAllPassed;
}

/// A gate holds no night against what the baseline has not: holes are frozen in by nobody unasked.
void RefuseUnfinished(const Results& results, const std::filesystem::path& folder) {
  const std::filesystem::path plan = folder / "plan.json";
  std::vector<RunSpec> planned;
  if (std::filesystem::exists(plan)) {
    planned = Plan(PlanFromJson(ReadFile(plan), plan.string()).suites);
  }
  const std::vector<std::string> unfinished = UnfinishedRuns(results, planned);
  if (unfinished.empty()) return;
  throw InputError(folder.string(), 0,
                   fmt::format("{} of its runs failed or {} missing, and a gate would not check "
                               "them: {}; run it again with --resume, or pass --anyway",
                               unfinished.size(), unfinished.size() == 1 ? "is" : "are",
                               FirstOfMany(unfinished, ", ")));
}

int SetBaseline(const std::string& folder, const std::string& to, bool anyway, bool json) {
  const Results results = ReadResults(folder);
  if (!anyway) RefuseUnfinished(results, folder);
  const Results baseline = BaselineOf(results);
  const std::filesystem::path path =
      to.empty() ? NewBaselinePath(baseline.suite) : std::filesystem::path(to);
  WriteFileAtomically(path, ToJson(baseline));
  if (const std::string blind = BlindFor(baseline); !blind.empty()) {
    fmt::print(stderr, "aisle: warning: {}\n", blind);
  }
  if (json) {
    fmt::print("{}", Dump({{"baseline", path.string()}, {"runs", baseline.runs.size()}}));
  } else {
    fmt::print("{}\n", path.string());
  }
  return kAllPassed;
}

}  // namespace

void AddCompareCommand(CLI::App* app, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app->add_subcommand(
      "compare",
      "Compare two reports, score by score: better, worse, same, cannot tell, unstable or gone");
  command->add_option("OLD", options->before, "Report folder or results.json of before")
      ->required();
  command->add_option("NEW", options->after, "Report folder or results.json of after")->required();
  command
      ->add_option("--alpha", options->compare.alpha,
                   "Chance of any false alarm in the whole comparison; default: 0.01")
      ->check(CLI::Range(0.0, 1.0));
  command
      ->add_option("--minimum-effect", options->compare.minimum_effect,
                   "Smallest difference that counts as a change, as a share of the old median; "
                   "default: 0.1")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--out", options->out,
                      "Folder for compare.html, compare.md and compare.json");
  AddJson(command, &options->json);
  command->footer(
      "Exit code 1 if a score is worse, unstable or gone, or cells or seeds of OLD are missing in "
      "NEW;\n5 if the two have nothing in common.\n"
      "Example: ./aisle compare out/yesterday out/tonight --out out/compared");
  command->callback([=] { *action = [=] { return CompareReports(*options); }; });
}

void AddBaselineCommand(CLI::App* app, Action* action) {
  const auto folder = std::make_shared<std::string>();
  const auto to = std::make_shared<std::string>();
  const auto anyway = std::make_shared<bool>(false), json = std::make_shared<bool>(false);
  CLI::App* command = app->add_subcommand(
      "baseline", "Make a report the baseline that `run --gate` compares its suite with");
  command->add_option("DIR", *folder, "Report folder, with results.json")->required();
  command->add_option(
      "--to", *to,
      "File to write, for `run --baseline`; default: reports/baselines/SUITE.json of "
      "the source tree this program was built from");
  command->add_flag("--anyway", *anyway, "Write the baseline even if runs failed or are missing");
  AddJson(command, json.get());
  command->footer("Example: ./aisle baseline out/quickstart --to my_quickstart.json");
  command->callback([=] { *action = [=] { return SetBaseline(*folder, *to, *anyway, *json); }; });
}

}  // namespace aisle
