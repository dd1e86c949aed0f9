#include "harness/cli/command.h"

namespace aisle {

void AddBenchCommand(CLI::App* app, Action* action) {
  CLI::App* bench =
      app->add_subcommand("bench", "Measure times, accuracy and quality on this machine");
  bench->require_subcommand(1);
  bench->footer("Example: ./aisle bench render --frames 20");
  AddBenchRender(bench, action);
  AddBenchGrowth(bench, action);
  AddBenchLight(bench, action);
  AddBenchSlam(bench, action);
  AddBenchAccuracy(bench, action);
  AddBenchDynamic(bench, action);
  AddBenchRealism(bench, action);
  AddBenchSensitivity(bench, action);
  AddBenchSearch(bench, action);
}

}  // namespace aisle
