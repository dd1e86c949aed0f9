#include "harness/campaign/inputs.h"

#include <filesystem>
#include <set>

#include "harness/campaign/source.h"
#include "harness/contract/stream.h"
#include "harness/io/input_error.h"
#include "harness/io/nearest_word.h"
#include "harness/io/shell_word.h"
#include "harness/judge/twins.h"
#include "harness/loop/closed_drive.h"
#include "harness/plugs/simulated_sequence.h"
#include "harness/plugs/steering_options.h"
#include "harness/plugs/systems.h"
#include "harness/plugs/wheel_odometry.h"
#include "harness/score/score_names.h"

namespace aisle {
namespace {

void CheckNames(const std::vector<std::string>& names, const std::vector<std::string>& known,
                const std::string& option) {
  std::set<std::string> seen;
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw InputError(fmt::format("{}: unknown name '{}': expected one of {}{}", option,
                                   Printable(name), fmt::join(known, ", "),
                                   DidYouMean(name, known)));
    }
    if (!seen.insert(name).second) {
      throw InputError(fmt::format("{}: duplicate '{}'; keep one of them", option, name));
    }
  }
}

/// The name of the system that a suite's `latencies_ms` made this one of; empty where they did not.
std::string NameBeforeSweep(const SystemSpec& spec) {
  const auto latency = spec.options.find("drive.latency_ms");
  if (latency == spec.options.end()) return "";
  const std::string ending = NameAtLatency("", latency->second);
  if (!spec.name.ends_with(ending)) return "";
  return spec.name.substr(0, spec.name.size() - ending.size());
}

/// The suite's system of that name; where its `latencies_ms` drive that system, at all of them.
std::vector<SystemSpec> OwnSystems(const Suite& suite, const std::string& name) {
  std::vector<SystemSpec> own;
  for (const SystemSpec& spec : suite.systems) {
    if (spec.name == name) return {spec};
    if (NameBeforeSweep(spec) == name) own.push_back(spec);
  }
  return own;
}

/// The names that may stand for systems of the suite; of one that is driven at several latencies,
/// its own as well.
std::vector<std::string> NamesIn(const Suite& suite) {
  std::vector<std::string> names = SystemNames(suite);
  for (const SystemSpec& spec : suite.systems) names.push_back(NameBeforeSweep(spec));
  std::erase(names, "");
  return names;
}

/// A suite's own systems may be chosen by name like any of ours.
std::vector<SystemSpec> ChooseSystems(const Suite& suite, const std::vector<std::string>& names,
                                      const Vocabulary& vocabulary) {
  std::vector<std::string> known = vocabulary.systems;
  for (const std::string& name : NamesIn(suite)) {
    if (std::find(known.begin(), known.end(), name) == known.end()) known.push_back(name);
  }
  CheckNames(names, known, "--systems");
  std::vector<SystemSpec> chosen;
  for (const std::string& name : names) {
    const std::vector<SystemSpec> own = OwnSystems(suite, name);
    chosen.insert(chosen.end(), own.begin(), own.end());
    if (own.empty()) chosen.push_back(BuiltIn(name));
  }
  for (auto spec = chosen.begin(); spec != chosen.end(); ++spec) {
    if (std::any_of(chosen.begin(), spec, [&](const auto& s) { return s.name == spec->name; })) {
      throw InputError(fmt::format("--systems: duplicate '{}'; keep one of them", spec->name));
    }
  }
  return chosen;
}

/// A limit on what the user leaves out is not asked this time. The file itself drives whatever its
/// limits name, or was refused.
void LeaveOutLimits(Suite* suite) {
  const auto left_out = [](const std::string& name, const std::vector<std::string>& chosen) {
    return !name.empty() && std::ranges::count(chosen, name) == 0;
  };
  suite->limits_left_out = std::erase_if(suite->limits, [&](const Limit& limit) {
    return left_out(limit.twin, suite->twins) ||
           left_out(TwinNeededBy(limit.score), suite->twins) ||
           left_out(limit.system, SystemNames(*suite));
  });
}

Suite LoadInput(const std::string& file, const InputOptions& options,
                const Vocabulary& vocabulary) {
  RefuseForeignYaml(file);
  Suite suite = IsSuiteFile(file) ? LoadSuite(file, vocabulary) : SuiteOfScene(file);
  if (!options.systems.empty()) suite.systems = ChooseSystems(suite, options.systems, vocabulary);
  if (!options.twins.empty()) suite.twins = options.twins;
  if (options.seeds > 0) {
    suite.seeds.clear();
    for (std::uint64_t seed = 1; seed <= options.seeds; ++seed) suite.seeds.push_back(seed);
  }
  if (!options.seed.empty()) suite.seeds = options.seed;
  LeaveOutLimits(&suite);
  return suite;
}

/// One of the systems that "robust.feature.features=800" can mean, and the rest of the text. Names
/// may hold dots: the longest that fits is meant.
std::pair<SystemSpec*, std::string> SystemOf(const std::string& text,
                                             std::vector<SystemSpec>* systems) {
  std::pair<SystemSpec*, std::string> found{nullptr, ""};
  std::size_t longest = 0;
  for (SystemSpec& spec : *systems) {
    if (spec.name.size() < longest || !text.starts_with(spec.name + ".")) continue;
    longest = spec.name.size();
    found = {&spec, text.substr(longest + 1)};
  }
  return found;
}

/// One option of a system behind a stream: how it steers.
std::string CheckSteeringOfOthers(const std::string& path, const std::string& value) {
  if (path == "drive.taught" && value == "true") {
    return "option drive.taught: only built-in systems can be taught, as an external one's map is "
           "unknown here";
  }
  return CheckOption(path, value);
}

std::string CheckSteering(const OptionTexts& options) {
  for (const auto& [path, value] : options) {
    if (std::string wrong = CheckSteeringOfOthers(path, value); !wrong.empty()) return wrong;
  }
  return Validate(SteeringOf(options));
}

/// One assignment may need another, whichever comes first: they are held against each other once
/// all are set. What the suite files say was good before.
void CheckTogether(const std::vector<Suite>& suites) {
  for (const Suite& suite : suites) {
    for (const SystemSpec& spec : suite.systems) {
      const std::string wrong = spec.external ? CheckSteering(spec.options)
                                              : CheckOptions(FindSystem(spec.like), spec.options);
      if (!wrong.empty()) throw InputError(fmt::format("--set, system '{}': {}", spec.name, wrong));
    }
  }
}

void SetOptions(const std::vector<std::string>& assignments, std::vector<Suite>* suites) {
  for (const std::string& text : assignments) {
    std::set<std::string> names;
    bool any = false;
    for (Suite& suite : *suites) {
      for (const std::string& name : SystemNames(suite)) names.insert(name);
      const auto [spec, assignment] = SystemOf(text, &suite.systems);
      if (spec == nullptr) continue;
      // How it steers is ours to say, as in suites; the rest is in its command's words.
      if (spec->external && !(IsStream(*spec->external) && IsSteeringOption(assignment))) {
        throw InputError(
            fmt::format("--set {}: '{}' is a command; pass its options in its command line",
                        Printable(text), spec->name));
      }
      any = true;
      const auto [path, value] = OptionFromText(assignment);
      spec->options[path] = value;
    }
    if (!any) {
      throw InputError(
          fmt::format("--set {}: expected SYSTEM.PATH=VALUE with one of {}, for example "
                      "robust.feature.features=800",
                      Printable(text), fmt::join(names, ", ")));
    }
  }
  if (!assignments.empty()) CheckTogether(*suites);
}

/// Systems that read a whole dataset first, on scenes that they would have to steer through.
std::string WhoCannotSteer(const Suite& suite) {
  std::string complaints;
  for (const SuiteScene& scene : suite.scenes) {
    if (!CheckSource(scene.file).empty() || !IsDriveSource(scene.file)) continue;
    for (const SystemSpec& system : suite.systems) {
      if (!system.external || IsStream(*system.external)) continue;
      complaints += fmt::format(
          "{}: system '{}' reads a dataset and cannot steer, as its frames depend on its "
          "estimates; remove it here, or give it `contract: stream`\n",
          scene.file, system.name);
    }
  }
  return complaints;
}

/// Systems that read a whole dataset first: it is written of scenes alone.
std::string WhoCannotRead(const Suite& suite) {
  std::string complaints;
  for (const SuiteScene& scene : suite.scenes) {
    if (!scene.recorded) continue;
    for (const SystemSpec& system : suite.systems) {
      if (!system.external || IsStream(*system.external)) continue;
      complaints += fmt::format(
          "{}: system '{}' reads a dataset, which is not written for a recording: give it "
          "`contract: stream`, or run it on the recording itself and use `aisle score`\n",
          scene.file, system.name);
    }
  }
  return complaints;
}

/// Limits and options that speak of steering, where no scene has a vehicle to steer: such a limit
/// could only fail after the night, and such a system would drive as it does without.
std::string WhatNeedsADrive(const Suite& suite) {
  const bool may_steer = std::ranges::any_of(suite.scenes, [](const SuiteScene& scene) {
    return !CheckSource(scene.file).empty() || IsDriveSource(scene.file);
  });
  if (may_steer) return "";
  std::string complaints;
  const auto complain = [&](const std::string& what) {
    complaints += fmt::format(
        "suite '{}': {} needs a scene with a `drive`, and it has none: reports/docs/steering.md\n",
        suite.name, what);
  };
  for (const Limit& limit : suite.limits) {
    if (IsDriveScore(limit.score)) complain(fmt::format("a limit on {}", limit.score));
  }
  for (const SystemSpec& system : suite.systems) {
    for (const auto& [path, value] : system.options) {
      if (path.starts_with("drive.")) complain(fmt::format("{} of '{}'", path, system.name));
    }
  }
  return complaints;
}

/// A recording is driven once, as it is: the plan passes twins and all seeds but the first over.
void RefuseWithoutEffect(const InputOptions& options, const std::vector<Suite>& suites) {
  const char* option = !options.twins.empty()    ? "--twins"
                       : options.seeds > 0       ? "--seeds"
                       : options.seed.size() > 1 ? "--seed with more than one"
                                                 : nullptr;
  const bool any_scene = std::ranges::any_of(suites, [](const Suite& suite) {
    return std::ranges::any_of(suite.scenes, [](const SuiteScene& s) { return !s.recorded; });
  });
  if (option == nullptr || any_scene) return;
  throw InputError(fmt::format(
      "{} has no effect: a recording is driven once, as it is; it has neither twins nor seeds",
      option));
}

}  // namespace

Vocabulary KnownNames() {
  Vocabulary vocabulary;
  for (const System& system : Systems()) vocabulary.systems.push_back(system.name);
  vocabulary.twins = TwinNames();
  vocabulary.check_score = [](const std::string& score) -> std::string {
    if (IsScoreName(score)) return {};
    std::vector<std::string> known;
    for (const ScoreDescription& description : ScoreNames()) known.push_back(description.name);
    return fmt::format("unknown score '{}'{}; `aisle score --list` lists all scores",
                       Printable(score), DidYouMean(score, known));
  };
  vocabulary.is_share = IsShare;
  vocabulary.check_option = [](const std::string& like, const std::string& path,
                               const std::string& value) -> std::string {
    if (!like.empty()) return CheckOption(path, value);
    if (path == kOdometryOption) return CheckOdometry(value);
    return IsSteeringOption(path) ? CheckSteeringOfOthers(path, value) : std::string();
  };
  vocabulary.check_options = [](const std::string& like,
                                const std::map<std::string, std::string>& options) {
    return CheckOptions(FindSystem(like), options);
  };
  return vocabulary;
}

std::vector<Suite> LoadInputs(const InputOptions& options) {
  const Vocabulary vocabulary = KnownNames();
  CheckNames(options.twins, vocabulary.twins, "--twins");
  std::vector<Suite> suites;
  for (const std::string& file : options.files) {
    suites.push_back(LoadInput(file, options, vocabulary));
  }
  RefuseWithoutEffect(options, suites);
  SetOptions(options.set, &suites);
  return suites;
}

std::string ComplaintsOf(const Suite& suite) {
  return WhoCannotSteer(suite) + WhoCannotRead(suite) + WhatNeedsADrive(suite);
}

void CheckScenes(const std::vector<Suite>& suites) {
  std::set<std::string> files;
  std::string complaints;
  for (const Suite& suite : suites) {
    for (const SuiteScene& scene : suite.scenes) {
      if (!files.insert(scene.file).second) continue;
      for (const std::string& complaint : CheckSource(scene.file)) complaints += complaint + "\n";
    }
  }
  for (const Suite& suite : suites) complaints += ComplaintsOf(suite);
  if (complaints.empty()) return;
  complaints.pop_back();
  throw InputError(complaints);
}

std::string Describe(const InputOptions& options) {
  std::vector<std::string> files;
  for (const std::string& file : options.files) files.push_back(ShellWord(file));
  std::string line = fmt::format("{}", fmt::join(files, " "));
  const auto add_names = [&](const char* option, const std::vector<std::string>& names) {
    if (names.empty()) return;
    line += fmt::format(" {} {}", option, ShellWord(fmt::format("{}", fmt::join(names, ","))));
  };
  add_names("--systems", options.systems);
  add_names("--twins", options.twins);
  if (options.seeds > 0) line += fmt::format(" --seeds {}", options.seeds);
  if (!options.seed.empty()) line += fmt::format(" --seed {}", fmt::join(options.seed, ","));
  for (const std::string& text : options.set) line += " --set " + ShellWord(text);
  return line;
}

}  // namespace aisle
