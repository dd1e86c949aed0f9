#include "harness/cli/command.h"
#include "harness/cli/terminal.h"
#include "harness/io/file.h"
#include "harness/io/places.h"
#include "harness/judge/change_size.h"
#include "harness/judge/compare.h"
#include "harness/judge/gate.h"
#include "harness/record/provenance.h"
#include "harness/record/record_json.h"
#include "harness/report/compare_text.h"
#include "harness/report/page/compare_page.h"
#include "harness/report/page/page.h"
#include "harness/report/page/resources.h"
#include "harness/report/report.h"

namespace aisle {
namespace {

struct Options {
  std::string before, after, out;
  CompareOptions compare;
  bool json = false;
};

/// A report's folder, or a results file such as a baseline.
Results ReadEither(const std::string& path) {
  return std::filesystem::is_directory(path) ? ReadResults(path)
                                             : ResultsFromJson(ReadFile(path), path);
}

ComparedNight NightOf(const std::string& path, const Results& results) {
  return {.name = path,
          .results = &results,
          .folder = std::filesystem::is_directory(path) ? std::filesystem::path(path)
                                                        : std::filesystem::path()};
}

void WritePages(const std::vector<Comparison>& comparisons, const ComparedNight& before,
                const ComparedNight& after, const std::filesystem::path& out) {
  WriteResources(out);
  WriteFileAtomically(out / "compare.md", ToMarkdown(comparisons));
  WriteFileAtomically(out / "compare.json", ToJson(comparisons));
  WriteFileAtomically(out / "compare.html",
                      Page(fmt::format("What changed from {} to {}", before.name, after.name), "",
                           ComparePage(comparisons, before, after, out)));
  fmt::print("report: {}\n", (out / "compare.html").string());
}

int CompareReports(const Options& options) {
  const Results before = ReadEither(options.before);
  const Results after = ReadEither(options.after);
  std::vector<Comparison> comparisons = Compare(before, after, options.compare);
  LargestFirst(&comparisons);
  fmt::print("{}", options.json ? ToJson(comparisons) : ToConsole(comparisons, StdoutHasColor()));
  if (!options.out.empty()) {
    WritePages(comparisons, NightOf(options.before, before), NightOf(options.after, after),
               options.out);
  }
  if (comparisons.empty()) {
    const std::string why = WhyNothingShared(before, after);
    fmt::print(stderr, "aisle: nothing can be compared: {}\n",
               why.empty() ? "no score of the one is in the other" : why);
    return kNothingToDo;
  }
  const bool worse = std::any_of(comparisons.begin(), comparisons.end(),
                                 [](const Comparison& c) { return IsAlarm(c.change); });
  return worse ? kVerdictFailed : kAllPassed;
}

int SetBaseline(const std::string& folder, const std::string& to, bool json) {
  const Results baseline = BaselineOf(ReadResults(folder));
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
      "what changed between two reports: better, worse, same, cannot tell, unstable, gone");
  command->add_option("OLD", options->before, "report folder or results.json")->required();
  command->add_option("NEW", options->after, "report folder or results.json")->required();
  command->add_option("--alpha", options->compare.alpha, "chance of any false alarm; default 0.01")
      ->check(CLI::Range(0.0, 1.0));
  command
      ->add_option("--minimum-effect", options->compare.minimum_effect,
                   "share of the old median below which nothing is called a change; default 0.1")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--out", options->out, "folder for compare.html, .md and .json");
  command->add_flag("--json", options->json, "for programs");
  command->footer("Example: ./aisle compare out/yesterday out/tonight --out out/compared");
  command->callback([=] { *action = [=] { return CompareReports(*options); }; });
}

void AddBaselineCommand(CLI::App* app, Action* action) {
  const auto folder = std::make_shared<std::string>();
  const auto to = std::make_shared<std::string>();
  const auto json = std::make_shared<bool>(false);
  CLI::App* command = app->add_subcommand(
      "baseline", "make a report the baseline that `run --gate` holds its suite against");
  command->add_option("DIR", *folder, "folder with results.json")->required();
  command->add_option(
      "--to", *to,
      "file to write, for `run --baseline`; default reports/baselines/SUITE.json of "
      "the source tree this program was built from");
  command->add_flag("--json", *json, "for programs");
  command->footer("Example: ./aisle baseline out/quickstart --to my_quickstart.json");
  command->callback([=] { *action = [=] { return SetBaseline(*folder, *to, *json); }; });
}

}  // namespace aisle
