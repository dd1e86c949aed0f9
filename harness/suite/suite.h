#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "harness/contract/run.h"
#include "harness/contract/system_spec.h"
#include "harness/contract/twin.h"
#include "harness/judge/limit.h"

namespace aisle {

struct SuiteScene {
  std::string name;  ///< "paper/scene2": the path below the scenes folder, without its ending
  std::string file;
  bool recorded = false;  ///< a recording: one twin, one seed, and nobody knows what moves

  bool operator==(const SuiteScene&) const = default;
};

/// A question asked of several systems on several scenes.
struct Suite {
  std::string name;
  std::string question;
  std::vector<SuiteScene> scenes;   ///< names are unique, as folders too (SafeName)
  std::vector<SystemSpec> systems;  ///< names are unique
  std::vector<std::string> twins = {twin::kLive};
  /// Nine show a shift of two standard deviations in 75 nights of 100, drawn anew each time.
  std::vector<std::uint64_t> seeds = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  std::vector<Limit> limits;
  /// How many of the file's limits are on systems or twins that the command line leaves out.
  std::size_t limits_left_out = 0;
};

/// What a suite may name.
struct Vocabulary {
  std::vector<std::string> systems;
  std::vector<std::string> twins;
  /// What is wrong with the name of a score, or an empty string.
  std::function<std::string(const std::string& score)> check_score;
  /// Whether a score is a share, from 0 to 1, as bounds of it must be.
  std::function<bool(const std::string& score)> is_share;
  /// What is wrong with an option of a built-in system and its value, or an empty string.
  std::function<std::string(const std::string& system, const std::string& path,
                            const std::string& value)>
      check_option;
  /// What is wrong with a variant's options together, each of which is good alone, or nothing.
  std::function<std::string(const std::string& system, const std::map<std::string, std::string>&)>
      check_options;
};

/// Reads a suite file; describe_suite.cc names its keys, reports/docs/suite.md explains them.
/// Scenes are sought from the suite's folder, then from the scenes folder that holds it; ".yaml"
/// may be left out. Throws InputError with every mistake of the file, each with
/// file:line:column, what was expected and an example.
Suite LoadSuite(const std::string& file, const Vocabulary& vocabulary);

/// A suite that asks one thing of one scene: what a bare scene file on the command line means.
Suite SuiteOfScene(const std::string& scene_file);

/// What suites of bare scenes ask: of more than three, the first two are named.
std::string QuestionOfScenes(const std::vector<std::string>& scene_names);

/// True where the file's top level has a key of suites alone (`suite`, `scenes`, `systems`), so
/// that a suite that lacks one of them is told as a suite; false for a scene. Throws InputError.
bool IsSuiteFile(const std::string& file);

/// True for a YAML file with none of the keys that each scene, suite or recording has one of: a
/// calibration, another tool's settings. Not a file that cannot be read: who opens it says why.
bool IsForeignYaml(const std::string& file);

/// Throws InputError where the file is foreign: one line in place of one for every key.
void RefuseForeignYaml(const std::string& file);

/// The name under which reports list a scene file.
std::string SceneName(const std::string& scene_file);

/// What a suite's `latencies_ms` makes of a system's name: "robust_50ms".
std::string NameAtLatency(const std::string& system, const std::string& latency_ms);

/// The names of the suite's systems, in its order.
std::vector<std::string> SystemNames(const Suite& suite);

/// JSON Schema of suite files (draft 7), for editors.
std::string SuiteSchema(const Vocabulary& vocabulary);

/// The suite file's page of the reference: every key with its meaning, default and example.
std::string SuiteReference(const Vocabulary& vocabulary);

/// Every cell of the suite: scenes, then twins, then seeds, then systems; runs that share their
/// frames are neighbours. A recording is driven once, as it is (twin live, the first seed), and not
/// by systems that are told what moves.
std::vector<RunSpec> Plan(const Suite& suite);

/// Every cell of several suites, each once. Throws InputError where two suites mean different
/// things by one name of a system or scene, or two runs would share a folder: their figures would
/// be mixed up.
std::vector<RunSpec> Plan(const std::vector<Suite>& suites);

}  // namespace aisle
