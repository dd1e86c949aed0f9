#include "harness/suite/suite.h"

#include <charconv>
#include <filesystem>
#include <sstream>

#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/suite/yaml_guard.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxSeeds = 1000;
constexpr const char* kExternalExample = "{name: mine, command: my_slam {dataset} {output}}";
constexpr const char* kNameRule = "letters, digits, '_', '.' and '-', 1 to 80 of them";

/// The comment a file opens with, as one line of text: what the suite asks when no key says so.
std::string OpeningComment(const std::string& text) {
  std::istringstream stream(text);
  std::string comment, line;
  while (std::getline(stream, line) && line.starts_with("#")) {
    const std::size_t first = line.find_first_not_of("# \t");
    if (first == std::string::npos) continue;
    if (!comment.empty()) comment += ' ';
    comment += line.substr(first);
  }
  return comment;
}

/// A suite file being read: knows where every complaint belongs.
class Reader {
 public:
  Reader(std::string file, const Vocabulary& vocabulary)
      : file_(std::move(file)), vocabulary_(vocabulary), root_(LoadYaml(file_)) {}

  Suite Read() const {
    RequireKeys(root_, {"suite", "question", "scenes", "systems", "twins", "seeds", "limits"},
                "suite: quickstart");
    Suite suite;
    suite.name = NameAt(Required("suite", "suite: quickstart"));
    suite.question = root_["question"] ? Text(root_["question"]) : OpeningComment(ReadFile(file_));
    for (const YAML::Node& scene : List(Required("scenes", "scenes: [paper/scene2]"))) {
      suite.scenes.push_back(SceneAt(scene));
    }
    for (const YAML::Node& system : List(Required("systems", "systems: [orbslam2, oracle]"))) {
      suite.systems.push_back(SystemAt(system, &suite));
    }
    if (root_["twins"]) suite.twins = Twins();
    if (root_["seeds"]) suite.seeds = Seeds(root_["seeds"]);
    if (root_["limits"]) {
      for (const YAML::Node& limit : List(root_["limits"])) {
        suite.limits.push_back(LimitAt(limit, suite));
      }
    }
    return suite;
  }

 private:
  [[noreturn]] void Fail(const YAML::Node& node, const std::string& message) const {
    FailAt(file_, node.Mark(), message);
  }

  void RequireKeys(const YAML::Node& node, const std::vector<std::string>& known,
                   const std::string& example) const {
    if (!node.IsMap()) Fail(node, "expected 'key: value' lines, for example '" + example + "'");
    for (const auto& entry : node) {
      const std::string key = entry.first.Scalar();
      if (std::find(known.begin(), known.end(), key) != known.end()) continue;
      Fail(entry.first, fmt::format("unknown key '{}': expected one of {}", Printable(key),
                                    fmt::join(known, ", ")));
    }
  }

  YAML::Node Required(const std::string& key, const std::string& example) const {
    const YAML::Node node = root_[key];
    if (!node) Fail(root_, fmt::format("key '{}' is missing, for example '{}'", key, example));
    return node;
  }

  std::string Text(const YAML::Node& node) const {
    if (!node.IsScalar() || node.Scalar().empty()) Fail(node, "expected a text");
    return node.Scalar();
  }

  std::string NameAt(const YAML::Node& node) const {
    const std::string name = Text(node);
    const bool good = name.size() <= 80 && name.find("..") == std::string::npos &&
                      name.find_first_not_of(
                          "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                          "0123456789_.-") == std::string::npos;
    if (!good) Fail(node, fmt::format("'{}' is no name: {}", Printable(name), kNameRule));
    return name;
  }

  std::vector<YAML::Node> List(const YAML::Node& node) const {
    if (node.IsScalar()) return {node};  // a list of one may drop its brackets
    if (!node.IsSequence() || node.size() == 0)
      Fail(node, "expected a list with an entry at least");
    return {node.begin(), node.end()};
  }

  std::string OneOf(const YAML::Node& node, const std::vector<std::string>& known,
                    const std::string& what) const {
    const std::string name = Text(node);
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      Fail(node, fmt::format("{} '{}' is not known: expected one of {}", what, Printable(name),
                             fmt::join(known, ", ")));
    }
    return name;
  }

  /// A known name, or a description, which is filed under its name.
  std::string SystemAt(const YAML::Node& node, Suite* suite) const {
    if (!node.IsMap()) return OneOf(node, vocabulary_.systems, "system");
    if (!node["name"]) {
      Fail(node, "a system of your own needs a name and a command, for example " +
                     std::string(kExternalExample));
    }
    const std::string name = NameAt(node["name"]);
    const auto& known = vocabulary_.systems;
    if (std::find(known.begin(), known.end(), name) != known.end()) {
      Fail(node["name"], "'" + name + "' is one of ours: choose another name");
    }
    if (suite->externals.count(name) + suite->imperfect.count(name) > 0) {
      Fail(node["name"], "'" + name + "' is already taken: choose another name");
    }
    if (node["like"]) {
      suite->imperfect[name] = ImperfectAt(node, name);
    } else {
      suite->externals[name] = ExternalAt(node, name);
    }
    return name;
  }

  ExternalSystem ExternalAt(const YAML::Node& node, const std::string& name) const {
    RequireKeys(node, {"name", "command", "contract", "dataset", "trajectory", "timeout_s"},
                kExternalExample);
    if (!node["command"]) {
      Fail(node, "a system of your own needs a name and a command, for example " +
                     std::string(kExternalExample));
    }
    ExternalSystem system;
    system.name = name;
    system.command = Text(node["command"]);
    if (node["contract"]) {
      OneOf(node["contract"], {"vslam-lab"}, "contract");
      system.vslam_lab = true;
    } else if (system.command.find("{output}") == std::string::npos) {
      Fail(node["command"], "the command must say where {output} goes, for example " +
                                std::string(kExternalExample));
    }
    if (node["dataset"]) system.dataset = OneOf(node["dataset"], {"euroc", "kitti"}, "dataset");
    if (node["trajectory"]) {
      system.trajectory = OneOf(node["trajectory"], {"tum", "kitti", "euroc"}, "trajectory");
    }
    if (system.vslam_lab && (node["dataset"] || node["trajectory"])) {
      Fail(node, "contract vslam-lab fixes dataset and trajectory: leave both out");
    }
    if (node["timeout_s"]) system.timeout_s = Number(node["timeout_s"]);
    if (system.timeout_s <= 0) Fail(node["timeout_s"], "expected more than 0 seconds");
    return system;
  }

  ImperfectSystem ImperfectAt(const YAML::Node& node, const std::string& name) const {
    const char* example = "{name: network, like: semantic, mask_errors: {boundary_px: 3}}";
    RequireKeys(node, {"name", "like", "mask_errors"}, example);
    if (!node["mask_errors"])
      Fail(node, fmt::format("expected mask_errors, for example {}", example));
    ImperfectSystem system{
        .name = name, .like = OneOf(node["like"], {"oracle", "semantic"}, "system"), .errors = {}};
    const YAML::Node& errors = node["mask_errors"];
    RequireKeys(errors, {"boundary_px", "miss_below_px", "miss_share", "latency_frames"}, example);
    if (errors["boundary_px"]) system.errors.boundary_px = Number(errors["boundary_px"]);
    if (errors["miss_share"]) system.errors.miss_share = Number(errors["miss_share"]);
    if (errors["miss_below_px"]) {
      system.errors.miss_below_px = static_cast<int>(Whole(errors["miss_below_px"]));
    }
    if (errors["latency_frames"]) {
      system.errors.latency_frames = static_cast<int>(Whole(errors["latency_frames"]));
    }
    if (const std::string broken = system.errors.Validate(); !broken.empty()) Fail(errors, broken);
    return system;
  }

  SuiteScene SceneAt(const YAML::Node& node) const {
    const std::string text = Text(node);
    const fs::path folder = fs::path(file_).parent_path();
    for (const fs::path& base : {folder, folder / ".."}) {
      for (const char* ending : {"", ".yaml"}) {
        const fs::path candidate = base / (text + ending);
        if (fs::is_regular_file(candidate)) {
          const std::string scene_file = candidate.lexically_normal().string();
          return {SceneName(scene_file), scene_file};
        }
      }
    }
    Fail(node, fmt::format("scene '{}' is neither below {} nor below {}", Printable(text),
                           folder.string(), (folder / "..").lexically_normal().string()));
  }

  std::vector<std::string> Twins() const {
    std::vector<std::string> twins;
    for (const YAML::Node& twin : List(root_["twins"])) {
      twins.push_back(OneOf(twin, vocabulary_.twins, "twin"));
    }
    return twins;
  }

  std::uint64_t Whole(const YAML::Node& node) const {
    const std::string text = Text(node);
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) {
      Fail(node, fmt::format("'{}' is no whole number, for example 'seeds: 3' or 'seeds: [1, 7]'",
                             Printable(text)));
    }
    return value;
  }

  std::vector<std::uint64_t> Seeds(const YAML::Node& node) const {
    std::vector<std::uint64_t> seeds;
    if (node.IsSequence()) {
      for (const YAML::Node& seed : List(node)) seeds.push_back(Whole(seed));
      return seeds;
    }
    const std::uint64_t count = Whole(node);
    if (count < 1 || count > kMaxSeeds)
      Fail(node, fmt::format("expected 1 to {} seeds", kMaxSeeds));
    for (std::uint64_t seed = 1; seed <= count; ++seed) seeds.push_back(seed);
    return seeds;
  }

  double Number(const YAML::Node& node) const {
    const std::string text = Text(node);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
      Fail(node, fmt::format("'{}' is no number", Printable(text)));
    }
    return value;
  }

  Limit LimitAt(const YAML::Node& node, const Suite& suite) const {
    const char* example = "{score: ate_rmse_m, system: oracle, twin: live, max: 0.02}";
    RequireKeys(node, {"score", "scene", "twin", "system", "min", "max"}, example);
    Limit limit;
    if (!node["score"]) Fail(node, fmt::format("a limit needs a score, for example {}", example));
    limit.score = NameAt(node["score"]);
    if (node["scene"]) {
      std::vector<std::string> scenes;
      for (const SuiteScene& scene : suite.scenes) scenes.push_back(scene.name);
      limit.scene = OneOf(node["scene"], scenes, "this suite's scene");
    }
    if (node["twin"]) limit.twin = OneOf(node["twin"], suite.twins, "this suite's twin");
    if (node["system"]) limit.system = OneOf(node["system"], suite.systems, "this suite's system");
    if (node["min"]) limit.min = Number(node["min"]);
    if (node["max"]) limit.max = Number(node["max"]);
    if (!limit.min && !limit.max) Fail(node, "a limit needs 'min', 'max' or both");
    return limit;
  }

  const std::string file_;
  const Vocabulary& vocabulary_;
  const YAML::Node root_;
};

}  // namespace

Suite LoadSuite(const std::string& file, const Vocabulary& vocabulary) {
  return Reader(file, vocabulary).Read();
}

bool IsSuiteFile(const std::string& file) {
  const YAML::Node root = LoadYaml(file);
  return root.IsMap() && root["suite"];
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

std::vector<RunSpec> Plan(const Suite& suite) {
  std::vector<RunSpec> specs;
  for (const SuiteScene& scene : suite.scenes) {
    for (const std::string& twin : suite.twins) {
      for (const std::uint64_t seed : suite.seeds) {
        for (const std::string& system : suite.systems) {
          specs.push_back({scene.name, scene.file, twin, system, seed});
        }
      }
    }
  }
  return specs;
}

}  // namespace aisle
