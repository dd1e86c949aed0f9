#include "harness/cli/inputs.h"

#include <filesystem>

#include "harness/io/input_error.h"
#include "harness/plugs/simulated_sequence.h"
#include "harness/plugs/systems.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

Suite SuiteOfScene(const std::string& file) {
  const std::string name = SceneName(file);
  Suite suite;
  suite.name = fs::path(name).filename().string();
  suite.question = "How do the systems fare on " + name + "?";
  suite.scenes = {{name, fs::path(file).lexically_normal().string()}};
  suite.systems = {"orbslam2", "oracle"};
  suite.seeds = {1};
  return suite;
}

void CheckNames(const std::vector<std::string>& names, const std::vector<std::string>& known,
                const std::string& option) {
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw InputError(fmt::format("{}: '{}' is not known: expected one of {}", option,
                                 Printable(name), fmt::join(known, ", ")));
  }
}

/// A suite's own commands may be chosen by name like any system.
std::vector<std::string> SystemsOf(const Suite& suite, const Vocabulary& vocabulary) {
  std::vector<std::string> names = vocabulary.systems;
  for (const auto& [name, external] : suite.externals) names.push_back(name);
  for (const auto& [name, system] : suite.imperfect) names.push_back(name);
  return names;
}

Suite LoadInput(const std::string& file, const InputOptions& options,
                const Vocabulary& vocabulary) {
  Suite suite = IsSuiteFile(file) ? LoadSuite(file, vocabulary) : SuiteOfScene(file);
  CheckNames(options.systems, SystemsOf(suite, vocabulary), "--systems");
  if (!options.systems.empty()) suite.systems = options.systems;
  if (!options.twins.empty()) suite.twins = options.twins;
  if (options.seeds > 0) {
    suite.seeds.clear();
    for (std::uint64_t seed = 1; seed <= options.seeds; ++seed) suite.seeds.push_back(seed);
  }
  if (!options.seed.empty()) suite.seeds = options.seed;
  return suite;
}

}  // namespace

Vocabulary KnownNames() {
  Vocabulary vocabulary;
  for (const System& system : Systems()) vocabulary.systems.push_back(system.name);
  vocabulary.twins = TwinNames();
  return vocabulary;
}

Suite LoadInputs(const InputOptions& options) {
  const Vocabulary vocabulary = KnownNames();
  CheckNames(options.twins, vocabulary.twins, "--twins");
  Suite whole = LoadInput(options.files.front(), options, vocabulary);
  for (std::size_t i = 1; i < options.files.size(); ++i) {
    const Suite more = LoadInput(options.files[i], options, vocabulary);
    whole.name += "+" + more.name;
    whole.question += " " + more.question;
    whole.scenes.insert(whole.scenes.end(), more.scenes.begin(), more.scenes.end());
    whole.externals.insert(more.externals.begin(), more.externals.end());
    whole.imperfect.insert(more.imperfect.begin(), more.imperfect.end());
    whole.limits.insert(whole.limits.end(), more.limits.begin(), more.limits.end());
  }
  return whole;
}

void CheckScenes(const Suite& suite) {
  std::string complaints;
  for (const SuiteScene& scene : suite.scenes) {
    for (const std::string& complaint : CheckScene(scene.file)) complaints += complaint + "\n";
  }
  if (complaints.empty()) return;
  complaints.pop_back();
  throw InputError(complaints);
}

std::string Describe(const InputOptions& options) {
  std::string line = fmt::format("{}", fmt::join(options.files, " "));
  if (!options.systems.empty())
    line += fmt::format(" --systems {}", fmt::join(options.systems, ","));
  if (!options.twins.empty()) line += fmt::format(" --twins {}", fmt::join(options.twins, ","));
  if (options.seeds > 0) line += fmt::format(" --seeds {}", options.seeds);
  if (!options.seed.empty()) line += fmt::format(" --seed {}", fmt::join(options.seed, ","));
  return line;
}

}  // namespace aisle
