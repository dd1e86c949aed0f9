// One run in a process of its own: what `aisle run` starts for every cell of a suite.
#include "harness/campaign/run_job.h"
#include "harness/cli/command.h"

namespace aisle {

void AddRunOneCommand(CLI::App* app, Action* action) {
  const auto file = std::make_shared<std::string>();
  CLI::App* command = app->add_subcommand("run-one", "Run one run of a suite in this process");
  command->group("");  // `run` calls it; people need not
  command->add_option("JOB", *file, "Job file of the run, job.json")->required();
  command->callback([=] {
    *action = [=] {
      RunJob(ReadJob(*file));
      return kAllPassed;
    };
  });
}

}  // namespace aisle
