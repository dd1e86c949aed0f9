#include "harness/suite/suite.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "harness/io/file.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

const Vocabulary kNames{{"orbslam2", "oracle"}, {"live", "empty"}};
constexpr const char* kGood =
    "suite: quick\n"
    "question: Does it hold?\n"
    "scenes: [paper/one]\n"
    "systems: [orbslam2, oracle]\n";

class SuiteTest : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::temp_directory_path() / fmt::format("aisle_suite_{}", ::getpid()) / "scenes";
    WriteFileAtomically(root_ / "paper/one.yaml", "scene: one\n");
    WriteFileAtomically(root_ / "paper/two.yaml", "scene: two\n");
  }
  void TearDown() override { fs::remove_all(root_.parent_path()); }

  Suite Load(const std::string& text) const {
    WriteFileAtomically(root_ / "suites/s.yaml", text);
    return LoadSuite((root_ / "suites/s.yaml").string(), kNames);
  }
  /// The message without the folder before the file's name.
  std::string Complaint(const std::string& text) const {
    try {
      Load(text);
    } catch (const InputError& error) {
      const std::string what = error.what();
      const std::size_t at = what.find("s.yaml");
      return at == std::string::npos ? what : what.substr(at);
    }
    return "no complaint";
  }

  fs::path root_;
};

TEST_F(SuiteTest, DefaultsAreTheLiveTwinAndNineSeeds) {
  const Suite suite = Load(kGood);
  EXPECT_EQ(suite.name, "quick");
  EXPECT_EQ(suite.scenes.at(0).name, "paper/one");
  EXPECT_EQ(suite.twins, std::vector<std::string>{"live"});
  EXPECT_EQ(suite.seeds, (std::vector<std::uint64_t>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_TRUE(IsSuiteFile((root_ / "suites/s.yaml").string()));
  EXPECT_FALSE(IsSuiteFile((root_ / "paper/one.yaml").string()));
}

TEST_F(SuiteTest, TheOpeningCommentAsksWhereNoKeyDoes) {
  const Suite suite =
      Load("# Does it\n# hold?\nsuite: q\nscenes: [paper/one]\nsystems: [oracle]\n# not this\n");
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
      {"suite: a\nquestion: b\nscenes: [paper/one]\n",
       "s.yaml:1:1: key 'systems' is missing, for example 'systems: [orbslam2, oracle]'"},
      {good + "colour: red\n",
       "s.yaml:5:1: unknown key 'colour': expected one of suite, question, scenes, systems, twins, "
       "seeds, limits"},
      {good + "suite: again\n",
       "s.yaml:5:1: key 'suite' appears twice (first in line 1): remove one"},
      {"suite: a\nquestion: b\nscenes: [paper/one]\nsystems: [best]\n",
       "s.yaml:4:11: system 'best' is not known: expected one of orbslam2, oracle"},
      {good + "twins: [dead]\n",
       "s.yaml:5:9: twin 'dead' is not known: expected one of live, empty"},
      {good + "seeds: many\n",
       "s.yaml:5:8: 'many' is no whole number, for example 'seeds: 3' or 'seeds: [1, 7]'"},
      {good + "seeds: 0\n", "s.yaml:5:8: expected 1 to 1000 seeds"},
      {good + "seeds: -1\n",
       "s.yaml:5:8: '-1' is no whole number, for example 'seeds: 3' or 'seeds: [1, 7]'"},
      {"suite: ../x\nquestion: b\nscenes: [paper/one]\nsystems: [oracle]\n",
       "s.yaml:1:8: '../x' is no name: letters, digits, '_', '.' and '-', 1 to 80 of them"},
      {"suite: \"\\\"><script>\"\nquestion: b\nscenes: [paper/one]\nsystems: [oracle]\n",
       "s.yaml:1:8: '\"><script>' is no name: letters, digits, '_', '.' and '-', 1 to 80 of them"},
      {good + "limits: [{system: oracle, max: 1}]\n",
       "s.yaml:5:10: a limit needs a score, for example {score: ate_rmse_m, system: oracle, twin: "
       "live, max: 0.02}"},
      {good + "limits: [{score: ate_rmse_m}]\n", "s.yaml:5:10: a limit needs 'min', 'max' or both"},
      {good + "limits: [{score: ate_rmse_m, max: tiny}]\n", "s.yaml:5:35: 'tiny' is no number"},
      {good + "limits: [{score: ate_rmse_m, twin: empty, max: 1}]\n",
       "s.yaml:5:36: this suite's twin 'empty' is not known: expected one of live"},
      {"suite: &a x\nquestion: *a\n",
       "s.yaml:1:8: anchors (&name) are not allowed: write the value out"},
      {"just a text\n", "s.yaml:1:1: expected 'key: value' lines, for example 'suite: quickstart'"},
      {"suite: [a\n", "s.yaml:2:1: is no YAML: end of sequence flow not found"},
      {std::string(40, '[') + std::string(40, ']'), "s.yaml:1:33: nested deeper than 32 levels"},
      {"suite: a\nquestion: [b]\nscenes: [paper/one]\nsystems: [oracle]\n",
       "s.yaml:2:11: expected a text"},
      {"suite: a\nquestion: b\nscenes: []\nsystems: [oracle]\n",
       "s.yaml:3:9: expected a list with an entry at least"},
  };
  for (const auto& [text, expected] : cases) EXPECT_EQ(Complaint(text), expected) << text;
  EXPECT_THAT(Complaint("suite: a\nquestion: b\nscenes: [paper/none]\nsystems: [oracle]\n"),
              testing::StartsWith("s.yaml:3:10: scene 'paper/none' is neither below"));
}

TEST_F(SuiteTest, ASystemMayBeWrappedForVslamLabOrToldSpoiltMasks) {
  const Suite suite = Load(
      "suite: a\nquestion: b\nscenes: [paper/one]\nsystems:\n"
      "  - {name: wrapped, contract: vslam-lab, command: slam}\n"
      "  - {name: network, like: oracle, mask_errors: {boundary_px: 2.5, latency_frames: 3}}\n");
  EXPECT_EQ(suite.systems, (std::vector<std::string>{"wrapped", "network"}));
  EXPECT_TRUE(suite.externals.at("wrapped").vslam_lab);
  EXPECT_EQ(suite.imperfect.at("network").errors,
            (MaskErrors{.boundary_px = 2.5, .latency_frames = 3}));
}

TEST(SceneNameTest, IsThePathBelowTheScenesFolder) {
  EXPECT_EQ(SceneName("/a/scenes/paper/scene2.yaml"), "paper/scene2");
  EXPECT_EQ(SceneName("/a/scenes/scene2.yaml"), "scene2");
  EXPECT_EQ(SceneName("/a/b/mine.yaml"), "mine");
}

}  // namespace
}  // namespace aisle
