#include "harness/suite/describe_suite.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "harness/contract/steering.h"
#include "harness/contract/stream.h"
#include "harness/contract/twin.h"
#include "harness/io/input_error.h"
#include "harness/io/nearest_word.h"
#include "harness/judge/twins.h"
#include "harness/systems/traits.h"

namespace aisle {
namespace {

constexpr int kMostSeeds = 1000;

bool IsAmong(const std::string& word, const std::vector<std::string>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

void DescribeMaskErrors(Fields& fields, MaskErrors& errors) {
  fields.Number(
      {"boundary_px", "standard deviation by which the outline is shifted, in pixels", "3"},
      &errors.boundary_px, {0, 100});
  fields.Integer(
      {"miss_below_px",
       "smallest visible size of an object, in pixels; smaller ones are never found", "600"},
      &errors.miss_below_px, {0, 1e9});
  fields.Number(
      {"miss_share", "share of the other objects that is missed, each for a while", "0.05"},
      &errors.miss_share, {0, 1});
  fields.Integer({"latency_frames", "number of frames by which the mask is late", "2"},
                 &errors.latency_frames, {0, 100});
}

/// The options that say how long a system takes for a frame.
constexpr std::array kLatencyOptions = {"drive.latency_ms", "drive.latency_profile_ms"};

/// What is wrong with both, or an empty string: a profile leaves the other no effect.
std::string TwoLatencies(const SystemSpec& system) {
  const auto given = [&](const char* path) { return system.options.contains(path); };
  if (!std::ranges::all_of(kLatencyOptions, given)) return "";
  return fmt::format("it has both {}; keep one of the two", fmt::join(kLatencyOptions, " and "));
}

/// A sweep would take the place of a latency, and have no effect beside a profile.
void CheckSweep(Fields& fields, const SystemSpec& system) {
  for (const char* path : kLatencyOptions) {
    if (!system.options.contains(path)) continue;
    fields.Fail("latencies_ms", fmt::format("'{}' has its own {}; keep one of the two",
                                            Printable(system.name), path));
  }
}

/// Each system that can steer once at each latency, in the place where it stood: "robust_50ms".
void SweepLatencies(Fields& fields, const std::vector<double>& latencies_ms,
                    std::vector<SystemSpec>* systems) {
  if (latencies_ms.empty()) return;
  std::vector<SystemSpec> swept;
  for (const SystemSpec& system : *systems) {
    if (system.external && !IsStream(*system.external)) {
      swept.push_back(system);  // it cannot steer
      continue;
    }
    CheckSweep(fields, system);
    for (const double ms : latencies_ms) {
      swept.push_back(system);
      const std::string latency = fmt::format("{:g}", ms);
      swept.back().name = NameAtLatency(system.name, latency);
      swept.back().options["drive.latency_ms"] = latency;
    }
  }
  *systems = std::move(swept);
}

std::string CheckAbsolute(const std::string& folder) {
  return folder.starts_with('/') ? "" : "expected an absolute path";
}

std::string CheckVariable(const std::string& name) {
  const bool good = name.find_first_not_of(
                        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
                        "0123456789_") == std::string::npos;
  return good ? "" : "expected the name of a variable";
}

void DescribeExternal(Fields& fields, ExternalSystem& external) {
  fields.Text({"command",
               "command of an external system; {dataset}, {calibration}, {output}, {seed} and "
               "{source} are filled in",
               "my_slam {dataset} {calibration} {output}"},
              &external.command);
  std::string contract;
  fields.Name({"contract",
               "how the command is called; vslam-lab: as a system wrapped for VSLAM-LAB, "
               "unchanged; vslam-lab-python: the same, with arguments as --key value; stream: it "
               "receives frames on its stdin and answers each on its stdout, so that it can steer",
               "vslam-lab"},
              &contract, {{"vslam-lab", "vslam-lab-python", "stream"}});
  if (contract == "stream") external.dataset = external.trajectory = kStreamFormat;
  if (contract == "vslam-lab") external.vslam_lab = VslamLabStyle::kWords;
  if (contract == "vslam-lab-python") external.vslam_lab = VslamLabStyle::kPython;
  fields.Name({"dataset", "layout of the dataset that is exported for the command", "euroc"},
              &external.dataset, {{"euroc", "kitti"}});
  fields.Name({"trajectory", "format of the trajectory that the command writes to {output}", "tum"},
              &external.trajectory, {{"tum", "kitti", "euroc"}});
  fields.Number({"timeout_s", "seconds after which the command is stopped", "600"},
                &external.timeout_s, {1e-3, 1e9});
  fields.Text({"version", "command whose first line of output names the version that ran",
               "my_slam --version"},
              &external.version);
  fields.Text(
      {"repository",
       "git repository of its sources, for `aisle bisect`; the command's {source} stands for it",
       "/srv/my_slam"},
      &external.repository);
  fields.Text({"build", "command that builds a checkout of the repository, run inside it",
               "cmake -B build && cmake --build build"},
              &external.build);
  fields.Integer({"repeats",
                  "number of times each input is run, for a system whose results vary on the same "
                  "input; shown separately from the spread over seeds",
                  "5"},
                 &external.repeats, {1, 100});
  fields.Texts(
      {"may_write", "folders that it may write to, besides the run's own", "[/srv/models/cache]"},
      &external.may_write, CheckAbsolute);
  fields.Texts({"environment",
                "variables that it may see, besides PATH, HOME, the locale and those of Python, "
                "CUDA, OpenMP and ROS",
                "[MY_LICENCE]"},
               &external.environment, CheckVariable);
  fields.Texts({"depends_on",
                "files and folders that determine what it does, besides those that the command "
                "names; --resume checks them",
                "[models/net.pt]"},
               &external.depends_on, [](const std::string& path) -> std::string {
                 return std::filesystem::exists(path) ? "" : "no such file or folder";
               });
}

/// The first word in braces that nothing is filled in for; the shell's own ${word} is none.
std::string UnknownPlaceholder(const std::string& command, const std::vector<std::string>& known) {
  for (std::size_t at = 0; (at = command.find('{', at)) != std::string::npos; ++at) {
    const std::size_t end = command.find_first_not_of("abcdefghijklmnopqrstuvwxyz_", at + 1);
    const bool is_word = end != std::string::npos && end > at + 1 && command[end] == '}';
    if (!is_word || (at > 0 && command[at - 1] == '$')) continue;
    const std::string word = command.substr(at + 1, end - at - 1);
    if (!IsAmong(word, known)) return word;
  }
  return "";
}

void CheckPlaceholders(Fields& fields, const ExternalSystem& external) {
  std::vector<std::string> known = {"output", "seed"};
  if (!IsStream(external)) known.insert(known.begin(), {"dataset", "calibration"});
  if (!external.repository.empty()) known.emplace_back("source");
  const std::string word = UnknownPlaceholder(external.command, known);
  if (word.empty()) return;
  fields.Fail("command", word == "source"
                             ? "{source} stands for its repository, which is not given; example: "
                               "repository: /srv/my_slam"
                             : fmt::format("unknown placeholder {{{}}}{}; known: {{{}}}", word,
                                           DidYouMean(word, known), fmt::join(known, "}, {")));
}

void CheckExternal(Fields& fields, const ExternalSystem& external) {
  CheckPlaceholders(fields, external);
  if (!fields.Has("contract") && external.command.find("{output}") == std::string::npos) {
    fields.Fail("command",
                "the command must contain {output}; example: command: my_slam {dataset} {output}");
  }
  const bool fixed = external.vslam_lab != VslamLabStyle::kNone || IsStream(external);
  if (fixed && (fields.Has("dataset") || fields.Has("trajectory"))) {
    fields.Fail("contract", "it determines dataset and trajectory; remove both");
  }
}

void DescribeLimit(Fields& fields, const Vocabulary& vocabulary, const Suite& suite, Limit& limit) {
  fields.Name({"score", "name of the score, as in results.json", "ate_rmse_m", true}, &limit.score);
  if (fields.Has("score") && !limit.score.empty()) {
    if (const std::string wrong = vocabulary.check_score(limit.score); !wrong.empty()) {
      fields.Fail("score", wrong);
    }
  }
  std::vector<std::string> scenes;
  for (const SuiteScene& scene : suite.scenes) scenes.push_back(scene.name);
  fields.Text({"scene", "only for this scene of the suite", "paper/scene2"}, &limit.scene);
  if (!limit.scene.empty() && !scenes.empty() && !IsAmong(limit.scene, scenes)) {
    fields.Fail("scene", fmt::format("'{}' is not among this suite's scenes: {}",
                                     Printable(limit.scene), fmt::join(scenes, ", ")));
  }
  fields.Name({"twin", "only for this twin of the suite", twin::kLive}, &limit.twin,
              {vocabulary.twins});
  if (!limit.twin.empty() && !IsAmong(limit.twin, suite.twins)) {
    fields.Fail("twin", fmt::format("'{}' is not among this suite's twins: {}", limit.twin,
                                    fmt::join(suite.twins, ", ")));
  }
  std::vector<std::string> systems = SystemNames(suite);
  std::erase(systems, "");  // a system whose name was a mistake: told at its own place
  fields.Name({"system", "only for this system", "oracle"}, &limit.system, {systems});
  const Range bound = vocabulary.is_share(limit.score) ? Range{0, 1} : Range{};
  fields.OptionalNumber(
      {"min", "lowest value that the median over seeds, or a share of the seeds, may have", "0.99"},
      &limit.min, bound);
  fields.OptionalNumber(
      {"max", "highest value that the median over seeds, or a share of the seeds, may have",
       "0.02"},
      &limit.max, bound);
  fields.OptionalNumber({"share",
                         "share of the seeds that must keep the bound individually, where 1 is "
                         "every seed; absent: the median must",
                         "1"},
                        &limit.share, {0, 1});
  if (limit.share && *limit.share <= 0) {
    fields.Fail("share", "must be greater than 0, or no seed would have to keep the bound");
  }
  const std::string needed = TwinNeededBy(limit.score);
  if (!needed.empty() && !IsAmong(needed, suite.twins)) {
    fields.Fail("score", fmt::format("{} requires the twin '{}' among the suite's twins",
                                     limit.score, needed));
  }
  if (!limit.min && !limit.max) fields.Fail("score", "a limit needs 'min', 'max' or both");
  if (limit.min && limit.max && *limit.min > *limit.max) {
    fields.Fail("min", "it is greater than 'max': no run could pass");
  }
}

/// Names that two systems share would mix their figures up.
void CheckNames(Fields& fields, const std::vector<SystemSpec>& systems, std::size_t i) {
  for (std::size_t j = 0; j < i; ++j) {
    if (systems[j].name.empty() || systems[j].name != systems[i].name) continue;
    return fields.Fail("name", fmt::format("'{}' is already taken; choose another name",
                                           Printable(systems[i].name)));
  }
}

}  // namespace

void Describe(Fields& fields, const Vocabulary& vocabulary, SystemSpec* spec) {
  const Words ours{vocabulary.systems};
  fields.Name(
      {"name", "name in reports; a bare word is a built-in system as it is", "robust_fast", true},
      &spec->name, fields.IsPlain() ? ours : Words{});
  const bool is_ours = IsAmong(spec->name, vocabulary.systems);
  if (fields.IsPlain()) {
    if (is_ours) spec->like = spec->name;
    return;
  }
  fields.Name({"like", "built-in system that it is a variant of", "robust"}, &spec->like, ours);
  fields.Values(
      {"options",
       "options that differ from the built-in system's, by path; `aisle systems` lists them",
       "{feature.features: 800}"},
      &spec->options, [&](const std::string& path, const std::string& value) {
        return vocabulary.check_option(spec->like, path, value);
      });
  fields.Group(
      {"mask_errors", "errors to add to the masks that a system like oracle or semantic receives",
       "{boundary_px: 3, miss_share: 0.05}"},
      [&](Fields& part) { DescribeMaskErrors(part, spec->mask_errors); });
  ExternalSystem external;
  DescribeExternal(fields, external);
  if (fields.Has("command")) {
    CheckExternal(fields, external);
    spec->external = external;
  }
  if (spec->name.empty()) return;
  if (is_ours) {
    return fields.Fail(
        "name", fmt::format("'{0}' is a built-in system; give the variant another name; example: "
                            "{{name: {0}_2, like: {0}, options: {{feature.features: 800}}}}",
                            spec->name));
  }
  if (const std::string wrong = TwoLatencies(*spec); !wrong.empty()) {
    return fields.Fail("options", wrong);
  }
  // How it steers any system can be told that answers frame by frame, whoever made it; what wheels
  // measure any.
  SystemSpec others = *spec;
  if (spec->external) others.options.erase(kOdometryOption);
  if (spec->external && IsStream(*spec->external)) {
    std::erase_if(others.options,
                  [](const auto& option) { return option.first.starts_with("drive."); });
  }
  std::string wrong = CheckSpec(others);
  if (wrong.empty() && !spec->like.empty())
    wrong = vocabulary.check_options(spec->like, spec->options);
  if (!wrong.empty()) fields.Fail("name", wrong);
}

void Describe(Fields& fields, const Vocabulary& vocabulary, const Fields::Check& add_scene,
              Suite* into) {
  Suite& suite = *into;
  std::vector<std::string> scenes;
  fields.Name(
      {"suite", "name of the suite, of its report folder and of its baseline", "quickstart", true},
      &suite.name);
  fields.Text({"question", "question that the suite answers; absent: the file's opening comment",
               "\"Does a person who fills the image spoil the pose?\""},
              &suite.question);
  fields.Texts({"scenes",
                "scene files, from this folder or from the scenes folder; bags, and files that "
                "describe a recording",
                "[paper/scene2]", true},
               &scenes, add_scene);
  fields.List(
      {"systems", "systems under test: built-in ones, variants of them, commands",
       "[robust, {name: mine, command: my_slam {dataset} {output}}]", true},
      [&](std::size_t count) { suite.systems.resize(count); },
      [&](Fields& part, std::size_t i) {
        Describe(part, vocabulary, &suite.systems[i]);
        CheckNames(part, suite.systems, i);
      },
      "name");
  std::vector<double> latencies_ms;
  fields.Numbers({"latencies_ms",
                  "latencies at which each system that can steer is also run, named as in "
                  "robust_50ms; for scenes with a `drive`",
                  "[0, 50, 100, 200]"},
                 &latencies_ms, {0, kLongestLatency_ms});
  SweepLatencies(fields, latencies_ms, &suite.systems);
  fields.Names({"twins",
                "twins of each scene: live as written, empty without actors, frozen with them "
                "standing still, none, low, mid or high with those of at most that level",
                "[live, empty]"},
               &suite.twins, {vocabulary.twins});
  fields.CountOrList({"seeds",
                      "number of seeds, from 1 on, or a list; each seed changes who walks, when, "
                      "how fast and along which path",
                      "3"},
                     &suite.seeds, kMostSeeds);
  fields.List(
      {"limits", "bounds whose violation fails the run",
       "[{score: ate_rmse_m, system: oracle, max: 0.02}]"},
      [&](std::size_t count) { suite.limits.resize(count); },
      [&](Fields& part, std::size_t i) {
        DescribeLimit(part, vocabulary, suite, suite.limits[i]);
      });
}

}  // namespace aisle
