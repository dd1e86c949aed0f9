#include "harness/cli/command.h"
#include "harness/cli/terminal.h"
#include "harness/report/report.h"

namespace aisle {
namespace {

int Rebuild(const std::string& folder) {
  const Results results = ReadResults(folder);
  WriteReport(results, folder);
  fmt::print("{}report: {}/index.html\n", ToConsole(results, StdoutHasColor()), folder);
  return AllPassed(results) ? kAllPassed : kVerdictFailed;
}

}  // namespace

void AddReportCommand(CLI::App* app, Action* action) {
  const auto folder = std::make_shared<std::string>();
  CLI::App* command = app->add_subcommand("report", "rebuild the pages of a finished run");
  command->add_option("DIR", *folder, "folder with results.json")->required();
  command->footer("Example: ./aisle report out/quickstart");
  command->callback([=] { *action = [=] { return Rebuild(*folder); }; });
}

}  // namespace aisle
