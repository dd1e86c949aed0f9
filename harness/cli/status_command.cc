// How a night on a cluster goes, from the files of its folder and the queue.
#include "harness/cli/cluster_commands.h"
#include "harness/cli/cluster_wait.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

int Status(const std::string& folder) {
  const fs::path out = fs::absolute(folder).lexically_normal();
  if (!HasTasks(out)) {
    throw InputError(folder, 0, "has no run of a cluster; `aisle run --on` makes one");
  }
  const TaskList list = ReadTasks(out);
  const std::optional<Submission> submission = ReadSubmission(out);
  fmt::print("{}\n", ClusterProgress(list, out, submission));
  const std::optional<ClusterVerdict> verdict = ReadVerdict(out);
  if (verdict && verdict->submission == (submission ? submission->id : "")) {
    fmt::print("verdict: exit code {}, report: {}\n", verdict->exit_code,
               (out / "index.html").string());
    return verdict->exit_code;
  }
  const std::size_t missing = Unfinished(list, out).size();
  fmt::print("{} of {} tasks are not finished; no verdict yet\n", missing, list.tasks.size());
  return kInterrupted;
}

}  // namespace

void AddStatusCommand(CLI::App* app, Action* action) {
  const auto folder = std::make_shared<std::string>();
  CLI::App* command = app->add_subcommand("status", "Show the progress of a run on a cluster");
  command->add_option("DIR", *folder, "Report folder")->required();
  command->footer(
      "Exit code: the verdict's once there is one, 2 before.\n"
      "Example: ./aisle status out/paper");
  command->callback([=] { *action = [=] { return Status(*folder); }; });
}

}  // namespace aisle
