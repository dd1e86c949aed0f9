#include "harness/cli/command.h"
#include "harness/cli/common_options.h"
#include "harness/cli/publish.h"
#include "harness/cli/terminal.h"
#include "harness/io/file.h"
#include "harness/judge/limit.h"
#include "harness/report/allure.h"
#include "harness/report/block/score_table.h"
#include "harness/report/console.h"
#include "harness/report/paper/into_page.h"
#include "harness/report/report.h"

namespace aisle {
namespace {

struct Options {
  std::string folder, into, titled, allure;
  std::vector<std::string> scores;
  bool json = false;
};

std::string WithScores(const std::string& page, const BlockPlace& place, const Results& results,
                       const std::vector<std::string>& scores) {
  return WithBlock(page, place,
                   ScoreTable(results, scores) + "\n" +
                       BlockFoot(results.provenance, results.rerun, results.started));
}

int Rebuild(const Options& options) {
  const std::string& folder = options.folder;
  const Results results = ReadResults(folder);
  if (!options.into.empty()) {
    const BlockPlace place = ParseBlockPlace(options.into, "tables");
    const std::string page = ReadFile(place.file);
    WriteFileAtomically(place.file, options.scores.empty()
                                        ? WithTables(page, place, results, options.titled)
                                        : WithScores(page, place, results, options.scores));
    fmt::print("tables: {}\n", place.file);
    return kAllPassed;
  }
  const ReportOptions about = WithHistory(results, folder);
  if (!about.history_trouble.empty()) {
    fmt::print(stderr, "aisle: warning: the trends do not include this run: {}\n",
               about.history_trouble);
  }
  WriteReport(results, folder, about);
  if (!options.allure.empty()) WriteAllure(results, folder, options.allure);
  if (options.json) {
    fmt::print("{}", ToJson(results));
  } else {
    fmt::print("{}report: {}/index.html\n", ToConsole(results, LookOfStdout()), folder);
  }
  return AllPassed(results) ? kAllPassed : kVerdictFailed;
}

}  // namespace

void AddReportCommand(CLI::App* app, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app->add_subcommand("report", "Rebuild the pages of a finished run");
  command->add_option("DIR", options->folder, "Report folder, with results.json")->required();
  CLI::Option* json = AddJson(command, &options->json, "Print results.json instead of the table");
  command
      ->add_option("--into", options->into,
                   "Only write the paper's tables, into a block of a Markdown page: PAGE#BLOCK, or "
                   "PAGE for its block 'tables'")
      ->excludes(json);
  CLI::Option* scores =
      command
          ->add_option(
              "--scores", options->scores,
              "With --into: write these scores of every scene and system instead, separated "
              "by commas")
          ->delimiter(',')
          ->needs("--into");
  command
      ->add_option("--titled", options->titled,
                   "With --into: only write the tables with this text in their title")
      ->needs("--into")
      ->excludes(scores);
  command->add_option("--allure", options->allure, "Also write Allure results to this folder");
  command->footer(
      "Example: ./aisle report out/quickstart\n"
      "         ./aisle report out/paper --into reports/paper.md\n"
      "         ./aisle report out/empty --into reports/slam.md#static --scores "
      "ate_live_rmse_m,ate_rmse_m");
  command->callback([=] { *action = [=] { return Rebuild(*options); }; });
}

}  // namespace aisle
