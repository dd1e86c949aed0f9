#include <malloc.h>

#include <cstdio>

#include "harness/cli/command.h"
#include "harness/io/input_error.h"

namespace {

/// Images come and go by the megabyte in every frame. Memory that is handed back to the system and
/// mapped anew each time costs a frame milliseconds, more with every thread.
void KeepFreedMemory() {
#ifdef __GLIBC__
  constexpr int kMegabyte = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, 32 * kMegabyte);
  mallopt(M_TRIM_THRESHOLD, 1024 * kMegabyte);
#endif
}

int Run(int argc, char** argv) {
  CLI::App app{"aisle: simulation-in-the-loop tests for stereo visual SLAM in dynamic scenes"};
  app.set_version_flag("--version", AISLE_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 all passed, 1 a verdict failed, 2 interrupted (resumable), 3 own or "
      "machine failure,\n            4 wrong usage or input, 5 nothing selected.\n"
      "Example: ./aisle run scenes/suites/quickstart.yaml");
  aisle::Action action;
  aisle::AddRunCommand(&app, &action);
  aisle::AddRunOneCommand(&app, &action);
  aisle::AddRerunCommand(&app, &action);
  aisle::AddMergeCommand(&app, &action);
  aisle::AddPreviewCommand(&app, &action);
  aisle::AddGalleryCommand(&app, &action);
  aisle::AddRenderCommand(&app, &action);
  aisle::AddSlamCommand(&app, &action);
  aisle::AddVocabularyCommand(&app, &action);
  aisle::AddBenchCommand(&app, &action);
  aisle::AddScoreCommand(&app, &action);
  aisle::AddReportCommand(&app, &action);
  aisle::AddCompareCommand(&app, &action);
  aisle::AddBaselineCommand(&app, &action);
  aisle::AddCheckCommand(&app, &action);
  aisle::AddDoctorCommand(&app, &action);
  aisle::AddCompletionCommand(&app, &action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? aisle::kAllPassed : aisle::kBadInput;  // --help is no error
  }
  try {
    return action();
  } catch (const aisle::InputError& error) {
    fmt::print(stderr, "aisle: {}\n", error.what());
    return aisle::kBadInput;
  } catch (const std::exception& error) {
    fmt::print(stderr, "aisle: {}\n", error.what());
    return aisle::kOwnFailure;
  }
}

}  // namespace

int main(int argc, char** argv) {
  KeepFreedMemory();
  return Run(argc, argv);
}
