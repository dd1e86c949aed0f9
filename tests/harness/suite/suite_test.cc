#include "harness/suite/suite.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "harness/io/file.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// Two systems with one option, two scores.
Vocabulary Names() {
  Vocabulary names;
  names.systems = {"orbslam2", "oracle"};
  names.twins = {"live", "empty"};
  names.check_score = [](const std::string& score) -> std::string {
    return score == "ate_rmse_m" || score == "coverage" ? "" : "there is no score '" + score + "'";
  };
  names.is_share = [](const std::string& score) { return score == "coverage"; };
  names.check_option = [](const std::string&, const std::string& path,
                          const std::string& value) -> std::string {
    if (path.starts_with("drive.")) return "";
    if (path != "feature.features") return "there is no option '" + path + "'";
    return value == "-1" ? "feature.features: expected 1 to 10000" : "";
  };
  names.check_options = [](const std::string&,
                           const std::map<std::string, std::string>&) -> std::string { return ""; };
  return names;
}

constexpr const char* kGood =
    "suite: quick\n"
    "question: Does it hold?\n"
    "scenes: [paper/one]\n"
    "systems: [orbslam2, oracle]\n";

class SuiteTest : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::temp_directory_path() / fmt::format("aisle_suite_{}", ::getpid()) / "scenes";
    WriteFileAtomically(root_ / "paper/one.yaml", "about: one\n");
    WriteFileAtomically(root_ / "paper/two.yaml", "about: two\n");
  }
  void TearDown() override { fs::remove_all(root_.parent_path()); }

  Suite Load(const std::string& text) const {
    WriteFileAtomically(root_ / "suites/s.yaml", text);
    return LoadSuite((root_ / "suites/s.yaml").string(), Names());
  }
  /// The messages, without the folder before the file's name.
  std::string Complaint(const std::string& text) const {
    try {
      Load(text);
    } catch (const InputError& error) {
      std::string what = error.what();
      const std::string folder = (root_ / "suites/").string();
      for (std::size_t at; (at = what.find(folder)) != std::string::npos;) {
        what.erase(at, folder.size());
      }
      return what;
    }
    return "no complaint";
  }
  /// The same of a suite whose systems are these.
  std::string ComplaintOfSystem(const std::string& system) const {
    return Complaint("suite: a\nscenes: [paper/one]\nsystems:\n  - " + system + "\n");
  }

  fs::path root_;
};

/// A megabyte of them is soon held apart.
TEST_F(SuiteTest, ManySeedsAreHeldApartInLittleTime) {
  std::string text = std::string(kGood) + "seeds: [";
  constexpr std::uint64_t kSeeds = 100'000;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) text += fmt::format("{},", seed);
  EXPECT_EQ(Load(text + "0]\n").seeds.size(), kSeeds + 1);
  EXPECT_THAT(Complaint(text + "1]\n"), HasSubstr("seeds: duplicate 1; keep one of them"));
}

TEST_F(SuiteTest, DefaultsAreTheLiveTwinAndNineSeeds) {
  const Suite suite = Load(kGood);
  EXPECT_EQ(suite.name, "quick");
  EXPECT_EQ(suite.scenes.at(0).name, "paper/one");
  EXPECT_EQ(suite.systems, (std::vector{BuiltIn("orbslam2"), BuiltIn("oracle")}));
  EXPECT_EQ(suite.twins, std::vector<std::string>{"live"});
  EXPECT_EQ(suite.seeds, (std::vector<std::uint64_t>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_TRUE(IsSuiteFile((root_ / "suites/s.yaml").string()));
  EXPECT_FALSE(IsSuiteFile((root_ / "paper/one.yaml").string()));
}

TEST_F(SuiteTest, ASuiteWithoutItsNameIsToldAsASuite) {
  const std::string complaint = Complaint("scenes: paper/one\nsystems: oracle\n");
  EXPECT_TRUE(IsSuiteFile((root_ / "suites/s.yaml").string()));
  EXPECT_THAT(complaint, HasSubstr("suite: missing key"));
  EXPECT_THAT(complaint, Not(HasSubstr("hall")));
}

TEST_F(SuiteTest, AMistakenNameIsNoneThatALimitMayName) {
  const std::string complaint = Complaint(
      "suite: a\nscenes: paper/one\nsystems: [oracel, orbslam2]\n"
      "limits: [{score: coverage, system: nobody, min: 1}]\n");
  EXPECT_THAT(complaint, HasSubstr("limits[0].system: expected one of orbslam2, got 'nobody'"));
}

TEST_F(SuiteTest, FilesWithoutAnyKeyOfOursAreForeign) {
  const auto is_foreign = [&](const std::string& text) {
    const std::string file = (root_ / "x.yaml").string();
    WriteFileAtomically(file, text);
    return IsForeignYaml(file);
  };
  EXPECT_TRUE(is_foreign("klt_win_size: 24\nklt_max_iter: 30\n"));
  EXPECT_FALSE(is_foreign("recording: drive\n"));
  EXPECT_FALSE(is_foreign("extend: one.yaml\n"));
  EXPECT_FALSE(is_foreign("halll: {}\nabout: A hall.\n")) << "one wrong key beside a right one";
  EXPECT_FALSE(is_foreign("a: [\n")) << "who opens it says what is wrong";
  EXPECT_FALSE(is_foreign("")) << "an empty file is told what it lacks";
  EXPECT_FALSE(IsForeignYaml((root_ / "paper/one.yaml").string()));
}

TEST_F(SuiteTest, TheOpeningCommentAsksWhereNoKeyDoes) {
  const Suite suite = Load(
      "# yaml-language-server: $schema=x\n# Does it\n# hold?\nsuite: q\nscenes: paper/one\n"
      "systems: oracle\n# not this\n");
  EXPECT_EQ(suite.question, "Does it hold?");
}

TEST_F(SuiteTest, EveryCellIsPlannedAndFramesAreSharedByNeighbours) {
  const Suite suite = Load(
      "suite: q\nquestion: q\nscenes: [paper/one, ../paper/two.yaml]\nsystems: [orbslam2, oracle]\n"
      "twins: [live, empty]\nseeds: 2\n");
  const std::vector<RunSpec> specs = Plan(suite);
  ASSERT_EQ(specs.size(), 16u);
  for (std::size_t i = 0; i < specs.size(); i += 2) {
    EXPECT_EQ(specs[i].scene, specs[i + 1].scene);
    EXPECT_EQ(specs[i].twin, specs[i + 1].twin);
    EXPECT_EQ(specs[i].seed, specs[i + 1].seed);
    EXPECT_NE(specs[i].system, specs[i + 1].system);
  }
  EXPECT_EQ(Load(std::string(kGood) + "seeds: [3, 9]\n").seeds, (std::vector<std::uint64_t>{3, 9}));
}

TEST_F(SuiteTest, MistakesAreNamedWithPlaceAndRemedy) {
  const std::string good = kGood;
  const std::pair<std::string, std::string> cases[] = {
      {"suite: a\nquestion: b\nscenes: [paper/one]\n", "s.yaml:1:1: systems: missing key"},
      {good + "colour: red\n", "s.yaml:5:1: colour: unknown key; known keys: suite"},
      {good + "seds: 3\n", "s.yaml:5:1: seds: unknown key; did you mean seeds?"},
      {good + "suite: again\n",
       "s.yaml:5:1: duplicate key 'suite' (first in line 1); keep one of them"},
      {good + "---\nlimits: [{nonsense: 1}]\n",
       "s.yaml:5:1: expected one YAML document, got several"},
      {"suite: a\nscenes: [paper/one]\nsystems: [orbslam]\n",
       "s.yaml:3:11: systems[0].name: expected one of orbslam2, oracle (did you mean orbslam2?), "
       "got 'orbslam'"},
      {good + "twins: [dead]\n", "s.yaml:5:9: twins: 'dead': expected one of live, empty"},
      {good + "twins: [live, live]\n", "s.yaml:5:15: twins: duplicate 'live'"},
      {good + "seeds: many\n",
       "s.yaml:5:8: seeds: expected a number of seeds (1 to 1000), or a list of integers, got "
       "'many'"},
      {good + "seeds: 0\n", "s.yaml:5:8: seeds: expected a number of seeds (1 to 1000)"},
      {good + "seeds: -1\n", "s.yaml:5:8: seeds: expected a number of seeds (1 to 1000)"},
      {good + "seeds: [1, 2, 1]\n", "s.yaml:5:15: seeds: duplicate 1"},
      {"suite: ../x\nscenes: [paper/one]\nsystems: [oracle]\n",
       "s.yaml:1:8: suite: expected a name of 1 to 80 letters, digits, '_', '.' and '-', "
       "got '../x'"},
      {good + "limits: [{system: oracle, max: 1}]\n", "s.yaml:5:10: limits[0].score: missing key"},
      {good + "limits: [{score: ate_rmse, max: 1}]\n",
       "s.yaml:5:18: limits[0].score: there is no score 'ate_rmse'"},
      {good + "limits: [{score: ate_rmse_m}]\n", "a limit needs 'min', 'max' or both"},
      {good + "limits: [{score: coverage, min: 99}]\n",
       "s.yaml:5:33: limits[0].min: expected a number from 0 to 1, got '99'"},
      {good + "limits: [{score: ate_rmse_m, min: 2, max: 1}]\n", "it is greater than 'max'"},
      {good + "limits: [{score: ate_rmse_m, max: tiny}]\n",
       "s.yaml:5:35: limits[0].max: expected a number, got 'tiny'"},
      {good + "limits: [{score: ate_rmse_m, max: 1, share: 1.5}]\n",
       "s.yaml:5:45: limits[0].share: expected a number from 0 to 1, got '1.5'"},
      {good + "limits: [{score: ate_rmse_m, max: 1, share: 0}]\n",
       "s.yaml:5:45: limits[0].share: must be greater than 0"},
      {good + "limits: [{score: dynamic_penalty, max: 1}]\n",
       "s.yaml:5:18: limits[0].score: dynamic_penalty requires the twin 'empty'"},
      {good + "limits: [{score: ate_rmse_m, twin: dead, max: 1}]\n",
       "s.yaml:5:36: limits[0].twin: expected one of live, empty"},
      {good + "limits: [{score: ate_rmse_m, twin: empty, max: 1}]\n",
       "s.yaml:5:36: limits[0].twin: 'empty' is not among this suite's twins: live"},
      {"suite: &a x\nquestion: *a\n",
       "s.yaml:1:8: anchors (&name) are not allowed; write the value out"},
      {"just a text\n", "s.yaml:1:1: expected 'key: value' lines"},
      {"suite: a\nseeds:\n\t- 3\n", "s.yaml:3:1: not YAML: lines are indented by a tab"},
      {"suite: [a\n", "s.yaml:2:1: not YAML: end of sequence flow not found"},
      {std::string(40, '[') + std::string(40, ']'), "s.yaml:1:33: nested deeper than 32 levels"},
      {"suite: a\nquestion: [b]\nscenes: [paper/one]\nsystems: [oracle]\n",
       "s.yaml:2:11: question: expected a text, got a list of 1"},
      {"suite: a\nscenes: []\nsystems: [oracle]\n",
       "s.yaml:2:9: scenes: expected a list with at least one entry"},
      {"suite: a\nscenes: [paper/none]\nsystems: [oracle]\n",
       "s.yaml:2:10: scenes: 'paper/none': no such scene in"},
      {"suite: a\nscenes: [paper/one, ../paper/one.yaml]\nsystems: [oracle]\n",
       "would both be named 'paper/one'"},
      {"suite: a\nscenes: [paper/dock_1, \"paper/dock 1\"]\nsystems: [oracle]\n",
       "paper/dock 1.yaml would share the run folder 'paper.dock_1'; rename one"},
  };
  for (const char* file : {"paper/dock_1.yaml", "paper/dock 1.yaml"}) {
    WriteFileAtomically(root_ / file, "scene: dock\n");
  }
  for (const auto& [text, expected] : cases) EXPECT_THAT(Complaint(text), HasSubstr(expected));
}

TEST_F(SuiteTest, AllMistakesAreReportedInTheOrderOfTheirPlaces) {
  EXPECT_THAT(
      Complaint("suite: a/b\nscenes: [paper/none]\nsystems: [best]\ntwins: [dead]\nseeds: x\n"),
      testing::MatchesRegex("s.yaml:1:8: .*\ns.yaml:2:10: .*\ns.yaml:3:11: .*\ns.yaml:4:9: .*\n"
                            "s.yaml:5:8: .*"));
}

TEST_F(SuiteTest, ASystemIsOursAVariantToldSpoiltMasksOrACommand) {
  const Suite suite = Load(
      "suite: a\nquestion: b\nscenes: [paper/one]\nsystems:\n"
      "  - {name: fast, like: orbslam2, options: {feature.features: 800}}\n"
      "  - {name: network, like: oracle, mask_errors: {boundary_px: 2.5, latency_frames: 3}}\n"
      "  - {name: wrapped, contract: vslam-lab, command: slam}\n"
      "  - {name: mine, command: 'slam {dataset} {output}', dataset: kitti, timeout_s: 5}\n");
  EXPECT_EQ(suite.systems.at(0), (SystemSpec{.name = "fast",
                                             .like = "orbslam2",
                                             .options = {{"feature.features", "800"}},
                                             .mask_errors = {},
                                             .external = {}}));
  EXPECT_EQ(suite.systems.at(1).mask_errors, (MaskErrors{.boundary_px = 2.5, .latency_frames = 3}));
  EXPECT_EQ(suite.systems.at(2).external->vslam_lab, VslamLabStyle::kWords);
  EXPECT_EQ(suite.systems.at(3).external->dataset, "kitti");
  EXPECT_EQ(suite.systems.at(3).external->timeout_s, 5);
}

TEST_F(SuiteTest, BracesThatAreTheShellsOwnStay) {
  for (const std::string command :
       {"slam ${home} {output}", "cp {a,b} {output}", "awk \"{ print }\" {dataset} > {output}",
        "slam {} {output}", "slam {A} {output}", "slam {dataset} {calibration} {output} {seed}"}) {
    EXPECT_NO_THROW(Load("suite: a\nscenes: [paper/one]\nsystems:\n  - {name: mine, command: '" +
                         command + "'}\n"))
        << command;
  }
}

TEST_F(SuiteTest, PartsOfASystemMustFitTogether) {
  const std::pair<const char*, const char*> cases[] = {
      {"{name: oracle, options: {feature.features: 800}}", "'oracle' is a built-in system"},
      {"{name: x}", "it needs 'command', or 'like' with a built-in system"},
      {"{name: x, like: oracle, command: 'slam {output}'}", "not both"},
      {"{name: x, like: orbslam2, mask_errors: {boundary_px: 3}}", "told their masks"},
      {"{name: x, like: oracle, mask_errors: {boundary_px: 300}}", "from 0 to 100"},
      {"{name: x, command: slam}", "the command must contain {output}"},
      {"{name: x, command: slam, contract: vslam-lab, dataset: kitti}", "remove both"},
      {"{name: x, command: 'slam {output}', timeout_s: 0}", "timeout_s"},
      {"{name: x, command: 'slam {datset} {output}'}",
       "placeholder {datset} (did you mean dataset?)"},
      {"{name: x, command: 'slam {frames} {output}'}", "unknown placeholder {frames}"},
      {"{name: x, command: 'slam {dataset}', contract: stream}",
       "placeholder {dataset}; known: {output}"},
      {"{name: x, command: '{source}/slam {output}'}", "which is not given; example: repository"},
      {"{name: x, like: oracle, options: {feature.featurs: 8}}",
       "4:39: systems[0].options: there is no option 'feature.featurs'"},
      {"{name: x, like: oracle, options: {feature.features: -1}}", "expected 1 to 10000"},
      {"oracle\n  - oracle", "'oracle' is already taken"},
  };
  for (const auto& [system, expected] : cases) {
    EXPECT_THAT(ComplaintOfSystem(system), HasSubstr(expected)) << system;
  }
}

TEST_F(SuiteTest, ALatencyThatWouldHaveNoEffectIsRefused) {
  const std::string head = "suite: a\nscenes: [paper/one]\nsystems:\n";
  const std::string swept = "latencies_ms: [0, 50]\n";
  const std::pair<std::string, const char*> cases[] = {
      {"  - {name: x, like: oracle, options: {drive.latency_profile_ms: \"5,9\"}}\n" + swept,
       "s.yaml:5:15: latencies_ms: 'x' has its own drive.latency_profile_ms"},
      {"  - {name: x, command: slam, contract: stream, options: {drive.latency_ms: 9}}\n" + swept,
       "s.yaml:5:15: latencies_ms: 'x' has its own drive.latency_ms"},
      {"  - {name: x, like: oracle, options: {drive.latency_ms: 0, "
       "drive.latency_profile_ms: \"5,9\"}}\n",
       "s.yaml:4:38: systems[0].options: it has both drive.latency_ms and "
       "drive.latency_profile_ms"},
      {"  - oracle\nlatencies_ms: [50, 50.0]\n", "s.yaml:5:20: latencies_ms: duplicate 50"},
  };
  for (const auto& [text, expected] : cases) {
    EXPECT_THAT(Complaint(head + text), HasSubstr(expected)) << text;
  }
  const Suite good = Load(head + "  - oracle\n" + swept);
  EXPECT_EQ(good.systems.size(), 2u);
}

TEST_F(SuiteTest, SeveralSuitesKeepTheirOwnSystemsAndShareEqualCells) {
  Suite one = Load(kGood), other = Load(kGood);
  one.seeds = other.seeds = {1};
  other.systems = {BuiltIn("oracle"), {.name = "fast", .like = "orbslam2"}};
  const std::vector<RunSpec> specs = Plan(std::vector{one, other});
  std::vector<std::string> systems;
  for (const RunSpec& spec : specs) systems.push_back(spec.system.name);
  EXPECT_EQ(systems, (std::vector<std::string>{"orbslam2", "oracle", "fast"}));

  other.systems.back().name = "orbslam2";
  other.systems.back().options["feature.features"] = "800";
  EXPECT_THROW(Plan(std::vector{one, other}), InputError);  // one name, two systems
  other = one;
  other.scenes.front().file = (root_ / "paper/two.yaml").string();
  EXPECT_THROW(Plan(std::vector{one, other}), InputError);  // one name, two scenes
}

TEST_F(SuiteTest, TwoScenesOfOneRunFolderAreRefused) {
  const std::string long_name(80, 'x');
  const std::pair<std::string, std::string> pairs[] = {
      {"dock 1", "dock_1"}, {"a/b", "a.b"}, {long_name + "1", long_name + "2"}};
  for (const auto& [name, other_name] : pairs) {
    Suite one = Load(kGood), other = one;
    one.scenes = {{.name = name, .file = name + ".yaml"}};
    other.scenes = {{.name = other_name, .file = other_name + ".yaml"}};
    try {
      Plan(std::vector{one, other});
      ADD_FAILURE() << name;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(name + ".yaml"));
      EXPECT_THAT(error.what(), HasSubstr(other_name + ".yaml"));
      EXPECT_THAT(error.what(), HasSubstr("would share the run folder"));
    }
  }
}

TEST(SuiteSchemaTest, DescribesWhatTheReaderTakes) {
  const auto schema = nlohmann::json::parse(SuiteSchema(Names()));
  const auto& properties = schema.at("properties");
  for (const char* key : {"suite", "question", "scenes", "systems", "twins", "seeds", "limits"}) {
    EXPECT_TRUE(properties.contains(key)) << key;
  }
  EXPECT_EQ(schema.at("required"), (nlohmann::json{"suite", "scenes", "systems"}));
  const auto& system = properties.at("systems").at("items").at("anyOf");
  EXPECT_EQ(system.at(0).at("enum"), (nlohmann::json{"orbslam2", "oracle"}));
  EXPECT_TRUE(system.at(1).at("properties").contains("options"));
  EXPECT_FALSE(properties.at("limits").at("items").at("properties").at("max").contains("default"));
}

TEST(SuiteReferenceTest, HasARowForEveryKey) {
  const std::string page = SuiteReference(Names());
  for (const char* key : {"`suite`", "`systems[].options`", "`systems[].mask_errors.miss_share`",
                          "`limits[].max`", "`seeds`"}) {
    EXPECT_THAT(page, HasSubstr(key));
  }
}

TEST(SceneNameTest, IsThePathBelowTheScenesFolder) {
  EXPECT_EQ(SceneName("/a/scenes/paper/scene2.yaml"), "paper/scene2");
  EXPECT_EQ(SceneName("/a/scenes/scene2.yaml"), "scene2");
  EXPECT_EQ(SceneName("/a/b/mine.yaml"), "mine");
}

}  // namespace
}  // namespace aisle
