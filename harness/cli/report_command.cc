#include "harness/cli/command.h"
#include "harness/cli/terminal.h"
#include "harness/judge/limit.h"
#include "harness/report/console.h"
#include "harness/report/report.h"

namespace aisle {
namespace {

int Rebuild(const std::string& folder, bool json) {
  const Results results = ReadResults(folder);
  WriteReport(results, folder);
  if (json) {
    fmt::print("{}", ToJson(results));
  } else {
    fmt::print("{}report: {}/index.html\n", ToConsole(results, StdoutHasColor()), folder);
  }
  return AllPassed(results) ? kAllPassed : kVerdictFailed;
}

}  // namespace

void AddReportCommand(CLI::App* app, Action* action) {
  const auto folder = std::make_shared<std::string>();
  const auto json = std::make_shared<bool>(false);
  CLI::App* command = app->add_subcommand("report", "rebuild the pages of a finished run");
  command->add_option("DIR", *folder, "folder with results.json")->required();
  command->add_flag("--json", *json, "results.json on stdout instead of the table");
  command->footer("Example: ./aisle report out/quickstart");
  command->callback([=] { *action = [=] { return Rebuild(*folder, *json); }; });
}

}  // namespace aisle
