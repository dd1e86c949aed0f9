#include "harness/suite/suite.h"

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <span>
#include <sstream>

#include "harness/common/first_of_many.h"
#include "harness/contract/twin.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/io/places.h"
#include "harness/record/record.h"
#include "harness/suite/describe_suite.h"
#include "harness/suite/recording.h"
#include "harness/suite/suite_reader.h"
#include "harness/suite/yaml_guard.h"
#include "harness/systems/traits.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

/// The comment a file opens with, as one line of text: what the suite asks when no key says so.
std::string OpeningComment(const std::string& text) {
  std::istringstream stream(text);
  std::string comment, line;
  while (std::getline(stream, line) && line.starts_with("#")) {
    const std::size_t first = line.find_first_not_of("# \t");
    if (first == std::string::npos || line.starts_with("# yaml-language-server:")) continue;
    if (!comment.empty()) comment += ' ';
    comment += line.substr(first);
  }
  return comment;
}

/// The file that a suite of that folder means, or nothing.
std::optional<std::string> FindScene(const fs::path& folder, const std::string& text) {
  for (const fs::path& base : {folder, folder / "..", ScenesDir()}) {
    for (const char* ending : {"", ".yaml"}) {
      const fs::path candidate = base / (text + ending);
      std::error_code error;  // names that no file can have among them
      if (fs::is_regular_file(candidate, error)) return candidate.lexically_normal().string();
    }
  }
  return std::nullopt;
}

/// Adds the scene; what is wrong with it, or an empty string.
std::string AddScene(const fs::path& folder, const std::string& text, Suite* suite) {
  const std::optional<std::string> file = FindScene(folder, text);
  if (!file) {
    return fmt::format("no such scene in {}, {} or {}",
                       folder.empty() ? "this folder" : folder.string(),
                       (folder / "..").lexically_normal().string(), ScenesDir().string());
  }
  const SuiteScene scene{SceneName(*file), *file, IsRecording(*file)};
  for (const SuiteScene& other : suite->scenes) {
    if (other.name == scene.name) {
      return fmt::format(
          "{} and {} would both be named '{}'; rename one, or put them below folders of a folder "
          "named scenes",
          other.file, scene.file, scene.name);
    }
    if (SafeName(other.name) == SafeName(scene.name)) {
      return fmt::format("{} and {} would share the run folder '{}'; rename one", other.file,
                         scene.file, SafeName(scene.name));
    }
  }
  suite->scenes.push_back(scene);
  return "";
}

template <class Value, class Same>
void RequireSame(const std::vector<Value>& ones, const std::vector<Value>& others,
                 const std::string& what, const Same& same_file) {
  for (const Value& one : ones) {
    for (const Value& other : others) {
      if (one.name != other.name || same_file(one, other)) continue;
      throw InputError(
          fmt::format("two suites define different {} '{}', whose results would be mixed up; "
                      "rename one, or run them one after the other",
                      what, one.name));
    }
  }
}

/// Adds those that are not there yet. Folders of runs are told apart by letters, digits and the
/// first 80 characters of a name: two runs of one folder would be given one run's figures.
void AddEachOnce(const std::vector<RunSpec>& more, std::vector<RunSpec>* specs,
                 std::map<std::string, std::size_t>* by_id) {
  for (const RunSpec& spec : more) {
    const auto [at, is_new] = by_id->try_emplace(RunId(spec), specs->size());
    if (is_new) {
      specs->push_back(spec);
      continue;
    }
    const RunSpec& other = (*specs)[at->second];
    if (other == spec) continue;
    throw InputError(
        fmt::format("'{}' ({}, system {}) and '{}' ({}, system {}) would share the run folder "
                    "'{}'; rename one, or run them one after the other",
                    other.scene, other.scene_file, other.system.name, spec.scene, spec.scene_file,
                    spec.system.name, at->first));
  }
}

/// One of these is in every scene, suite and description of a recording.
constexpr std::initializer_list<const char*> kKeysOfOurs = {
    "suite", "scenes", "systems", "recording", "extend", "about", "rig", "hall", "lights"};

bool HasAKeyOf(const YAML::Node& root, std::initializer_list<const char*> keys) {
  return root.IsMap() &&
         std::ranges::any_of(keys, [&](const char* key) { return root[key].IsDefined(); });
}

}  // namespace

Suite LoadSuite(const std::string& file, const Vocabulary& vocabulary) {
  const YAML::Node root = LoadYaml(file);
  Issues issues(file);
  Suite suite;
  if (!root.IsMap()) {
    issues.Add({}, "", "expected 'key: value' lines; example: suite: quickstart");
  } else {
    YamlReader reader(root, "", &issues);
    const fs::path folder = fs::path(file).parent_path();
    Describe(
        reader, vocabulary, [&](const std::string& text) { return AddScene(folder, text, &suite); },
        &suite);
    reader.ReportKeys();
  }
  if (!issues.empty()) throw InputError(issues.Text());
  if (suite.question.empty()) suite.question = OpeningComment(ReadFile(file));
  return suite;
}

std::string QuestionOfScenes(const std::vector<std::string>& scene_names) {
  return fmt::format("How do the systems fare on {}?", FirstOfMany(scene_names, ", "));
}

Suite SuiteOfScene(const std::string& scene_file) {
  const std::string name = SceneName(scene_file);
  Suite suite;
  suite.name = fs::path(name).filename().string();
  suite.question = QuestionOfScenes({name});
  const bool recorded = IsRecording(scene_file);
  suite.scenes = {{name, fs::path(scene_file).lexically_normal().string(), recorded}};
  suite.systems = {BuiltIn("plain"), BuiltIn(recorded ? "robust" : "oracle")};
  suite.seeds = {1};
  return suite;
}

bool IsSuiteFile(const std::string& file) {
  const std::string ending = fs::path(file).extension().string();
  if (ending == ".mcap" || ending == ".db3") return false;
  return HasAKeyOf(LoadYaml(file), {"suite", "scenes", "systems"});
}

bool IsForeignYaml(const std::string& file) {
  if (fs::path(file).extension() != ".yaml") return false;
  try {
    const YAML::Node root = LoadYaml(file);
    return root.IsMap() && root.size() > 0 && !HasAKeyOf(root, kKeysOfOurs);
  } catch (const InputError&) {
    return false;
  }
}

void RefuseForeignYaml(const std::string& file) {
  if (!IsForeignYaml(file)) return;
  throw InputError(
      file, 1,
      fmt::format("neither a scene, a suite nor a recording: it has none of the keys {}",
                  fmt::join(kKeysOfOurs, ", ")));
}

std::string SceneName(const std::string& scene_file) {
  const fs::path path = fs::absolute(scene_file).lexically_normal();
  std::string name = path.stem().string();
  for (fs::path folder = path.parent_path(); folder != folder.root_path();
       folder = folder.parent_path()) {
    if (folder.filename() == "scenes") return name;
    name = folder.filename().string() + "/" + name;
  }
  return path.stem().string();  // not below a scenes folder: the bare name
}

std::string NameAtLatency(const std::string& system, const std::string& latency_ms) {
  return fmt::format("{}_{}ms", system, latency_ms);
}

std::vector<std::string> SystemNames(const Suite& suite) {
  std::vector<std::string> names;
  for (const SystemSpec& system : suite.systems) names.push_back(system.name);
  return names;
}

std::vector<RunSpec> Plan(const Suite& suite) {
  std::vector<RunSpec> specs;
  for (const SuiteScene& scene : suite.scenes) {
    const std::vector<std::string> twins =
        scene.recorded ? std::vector<std::string>{twin::kLive} : suite.twins;
    const std::size_t most_seeds = scene.recorded ? 1 : suite.seeds.size();
    const std::span<const std::uint64_t> seeds(suite.seeds.data(),
                                               std::min(suite.seeds.size(), most_seeds));
    for (const std::string& twin : twins) {
      for (const std::uint64_t seed : seeds) {
        for (const SystemSpec& system : suite.systems) {
          if (scene.recorded && TraitsOf(system).ReceivesMasks()) continue;
          const int repeats = system.external ? system.external->repeats : 1;
          for (int repeat = 1; repeat <= repeats; ++repeat) {
            specs.push_back({scene.name, scene.file, twin, system, seed, repeat});
          }
        }
      }
    }
  }
  return specs;
}

std::vector<RunSpec> Plan(const std::vector<Suite>& suites) {
  std::vector<RunSpec> specs;
  std::map<std::string, std::size_t> by_id;
  for (std::size_t i = 0; i < suites.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      RequireSame(suites[j].systems, suites[i].systems, "system", std::equal_to<SystemSpec>());
      RequireSame(suites[j].scenes, suites[i].scenes, "scene",
                  [](const SuiteScene& one, const SuiteScene& other) {
                    return fs::absolute(one.file).lexically_normal() ==
                           fs::absolute(other.file).lexically_normal();
                  });
    }
    AddEachOnce(Plan(suites[i]), &specs, &by_id);
  }
  return specs;
}

}  // namespace aisle
