#include "harness/cli/command.h"
#include "harness/io/input_error.h"
#include "harness/plugs/simulated_sequence.h"
#include "harness/plugs/systems.h"
#include "harness/suite/suite.h"

namespace aisle {
namespace {

Vocabulary KnownNames() {
  Vocabulary vocabulary;
  for (const System& system : Systems()) vocabulary.systems.push_back(system.name);
  vocabulary.twins = TwinNames();
  return vocabulary;
}

std::vector<std::string> Complaints(const std::string& file) {
  try {
    if (!IsSuiteFile(file)) return CheckScene(file);
    std::vector<std::string> complaints;
    for (const SuiteScene& scene : LoadSuite(file, KnownNames()).scenes) {
      for (const std::string& complaint : CheckScene(scene.file)) complaints.push_back(complaint);
    }
    return complaints;
  } catch (const InputError& error) {
    return {error.what()};
  }
}

int Check(const std::vector<std::string>& files) {
  std::size_t bad = 0;
  for (const std::string& file : files) {
    const std::vector<std::string> complaints = Complaints(file);
    for (const std::string& complaint : complaints) fmt::print(stderr, "{}\n", complaint);
    if (complaints.empty()) fmt::print("{}: good\n", file);
    bad += complaints.empty() ? 0 : 1;
  }
  return bad == 0 ? kAllPassed : kBadInput;
}

}  // namespace

void AddCheckCommand(CLI::App* app, Action* action) {
  const auto files = std::make_shared<std::vector<std::string>>();
  CLI::App* command = app->add_subcommand("check", "validate scene and suite files");
  command->add_option("FILE", *files, "scene or suite files")->required();
  command->footer("Example: ./aisle check scenes/paper/*.yaml scenes/suites/*.yaml");
  command->callback([=] { *action = [=] { return Check(*files); }; });
}

}  // namespace aisle
