#include "harness/cli/command_line.h"

#include <cstdio>

#include "harness/io/input_error.h"

namespace aisle {

void AddCommands(CLI::App* app, Action* action) {
  AddRunCommand(app, action);
  AddRunOneCommand(app, action);
  AddRerunCommand(app, action);
  AddMergeCommand(app, action);
  AddPreviewCommand(app, action);
  AddGalleryCommand(app, action);
  AddRenderCommand(app, action);
  AddSlamCommand(app, action);
  AddVocabularyCommand(app, action);
  AddBenchCommand(app, action);
  AddScoreCommand(app, action);
  AddReportCommand(app, action);
  AddCompareCommand(app, action);
  AddBaselineCommand(app, action);
  AddCheckCommand(app, action);
  AddDoctorCommand(app, action);
  AddCompletionCommand(app, action);
}

int RunCommandLine(int argc, const char* const* argv) {
  CLI::App app{"aisle: simulation-in-the-loop tests for stereo visual SLAM in dynamic scenes"};
  app.set_version_flag("--version", AISLE_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 all passed, 1 a verdict failed, 2 interrupted (resumable), 3 own or "
      "machine failure,\n            4 wrong usage or input, 5 nothing selected.\n"
      "Example: ./aisle run scenes/suites/quickstart.yaml");
  Action action;
  AddCommands(&app, &action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kAllPassed : kBadInput;  // --help is no error
  }
  try {
    return action();
  } catch (const InputError& error) {
    fmt::print(stderr, "aisle: {}\n", error.what());
    return kBadInput;
  } catch (const std::exception& error) {
    fmt::print(stderr, "aisle: {}\n", error.what());
    return kOwnFailure;
  }
}

}  // namespace aisle
