#include "harness/campaign/inputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "harness/io/file.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

const fs::path kTree = AISLE_SOURCE_DIR;

/// The text that a committed file should have; written there where AISLE_WRITE_SCHEMA is set.
void ExpectCommitted(const fs::path& file, const std::string& text) {
  if (std::getenv("AISLE_WRITE_SCHEMA") != nullptr) WriteFileAtomically(file, text);
  EXPECT_EQ(ReadFile(file), text) << file
                                  << " is behind: cmake --build build/release --target reference";
}

TEST(SuiteSchemaTest, TheCommittedSchemaIsTheReadersOwn) {
  ExpectCommitted(kTree / "scenes/suite.schema.json", SuiteSchema(KnownNames()));
}

TEST(SuiteReferenceTest, TheCommittedPageIsTheReadersOwn) {
  const std::string head =
      "# Suite files\n\nA suite asks one question of several systems on several scenes. Every key, "
      "as the reader\ndescribes it (`tests/harness/campaign` holds this page against it); an "
      "example stands in\n`scenes/suites/quickstart.yaml`, and `aisle check FILE` names every "
      "mistake of a file with its place.\n\n";
  ExpectCommitted(kTree / "reports/docs/suite.md", head + SuiteReference(KnownNames()));
}

TEST(SuiteFilesTest, EveryCommittedSuiteIsGoodAndNamesTheSchema) {
  for (const auto& entry : fs::directory_iterator(kTree / "scenes/suites")) {
    EXPECT_NO_THROW(LoadSuite(entry.path().string(), KnownNames())) << entry.path();
    EXPECT_THAT(ReadFile(entry.path()),
                HasSubstr("# yaml-language-server: $schema=../suite.schema.json"));
  }
}

class InputsTest : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::temp_directory_path() / fmt::format("aisle_inputs_{}", ::getpid());
    for (const char* scene : {"a/one", "b/one", "a/two"}) {
      WriteFileAtomically(root_ / "scenes" / (std::string(scene) + ".yaml"), "about: x\n");
    }
    first_ = Write("first", "suite: first\nscenes: [a/one]\nsystems: [orbslam2]\nseeds: 1\n");
    second_ = Write("second", "suite: second\nscenes: [b/one]\nsystems: [robust]\nseeds: 1\n");
  }
  void TearDown() override { fs::remove_all(root_); }

  std::string Write(const std::string& name, const std::string& text) const {
    const fs::path file = root_ / "scenes/suites" / (name + ".yaml");
    WriteFileAtomically(file, text);
    return file.string();
  }
  static std::vector<std::string> Cells(const InputOptions& options) {
    std::vector<std::string> cells;
    for (const RunSpec& spec : Plan(LoadInputs(options))) {
      cells.push_back(spec.scene + " " + spec.system.name);
    }
    return cells;
  }
  static std::string Complaint(const InputOptions& options) {
    try {
      Plan(LoadInputs(options));
    } catch (const InputError& error) {
      return error.what();
    }
    return "no complaint";
  }

  fs::path root_;
  std::string first_, second_;
};

TEST_F(InputsTest, EachSuiteIsDrivenWithItsOwnSystems) {
  EXPECT_EQ(Cells({.files = {first_, second_}}),
            (std::vector<std::string>{"a/one orbslam2", "b/one robust"}));
}

TEST_F(InputsTest, TheSameCellOfTwoSuitesIsRunOnce) {
  EXPECT_EQ(Cells({.files = {first_, first_}}), (std::vector<std::string>{"a/one orbslam2"}));
}

TEST_F(InputsTest, TwoScenesOfOneNameAreRefused) {
  const fs::path elsewhere = root_ / "elsewhere";
  WriteFileAtomically(elsewhere / "x/hall.yaml", "about: x\n");
  WriteFileAtomically(elsewhere / "y/hall.yaml", "about: y\n");
  EXPECT_THAT(Complaint({.files = {(elsewhere / "x/hall.yaml").string(),
                                   (elsewhere / "y/hall.yaml").string()}}),
              HasSubstr("two suites define different scene 'hall'"));
}

TEST_F(InputsTest, ASystemNamedTwiceOrMisspeltIsRefused) {
  EXPECT_THAT(Complaint({.files = {first_}, .systems = {"robust", "robust"}}),
              HasSubstr("duplicate 'robust'"));
  EXPECT_THAT(Complaint({.files = {first_}, .systems = {"robsut"}}),
              HasSubstr("did you mean robust?"));
}

TEST_F(InputsTest, ASystemOfASweepIsChosenAtAllItsLatencies) {
  const std::string swept = Write("swept",
                                  "suite: swept\nscenes: a/one\nlatencies_ms: [0, 50]\nsystems:\n"
                                  "  - robust\n  - {name: mine, like: plain}\n");
  const auto chosen = [&](const std::vector<std::string>& systems) {
    return SystemNames(LoadInputs({.files = {swept}, .systems = systems}).at(0));
  };
  EXPECT_THAT(chosen({"robust"}), ElementsAre("robust_0ms", "robust_50ms"));
  EXPECT_THAT(chosen({"mine", "robust_50ms"}), ElementsAre("mine_0ms", "mine_50ms", "robust_50ms"));
  EXPECT_THAT(chosen({"oracle"}), ElementsAre("oracle"));
  EXPECT_THAT(Complaint({.files = {swept}, .systems = {"robust", "robust_50ms"}}),
              HasSubstr("duplicate 'robust_50ms'"));
  EXPECT_THAT(Complaint({.files = {swept}, .systems = {"mien"}}), HasSubstr("did you mean mine?"));
}

TEST_F(InputsTest, SetChangesAnOptionOfOneSystem) {
  const std::vector<Suite> suites =
      LoadInputs({.files = {first_, second_}, .set = {"robust.feature.features=800"}});
  EXPECT_TRUE(suites[0].systems[0].options.empty());
  EXPECT_EQ(suites[1].systems[0].options.at("feature.features"), "800");
}

TEST_F(InputsTest, RecordingsHaveNeitherTwinsNorSeeds) {
  WriteFileAtomically(root_ / "scenes/a/drive.yaml", "recording: aisle3.mcap\n");
  const std::string drive = (root_ / "scenes/a/drive.yaml").string();
  const std::string both =
      Write("both", "suite: both\nscenes: [a/one, a/drive]\nsystems: [robust]\n");
  EXPECT_EQ(Complaint({.files = {drive}}), "no complaint");
  EXPECT_THAT(Complaint({.files = {drive}, .twins = {"empty"}}),
              HasSubstr("--twins has no effect"));
  EXPECT_THAT(Complaint({.files = {drive}, .seeds = 3}), HasSubstr("--seeds has no effect"));
  EXPECT_THAT(Complaint({.files = {drive}, .seed = {4, 5}}), HasSubstr("has no effect"));
  EXPECT_EQ(Complaint({.files = {drive}, .seed = {4}}), "no complaint");
  EXPECT_EQ(Complaint({.files = {both}, .twins = {"empty"}, .seeds = 3}), "no complaint");
  EXPECT_EQ(Complaint({.files = {drive, first_}, .seeds = 3}), "no complaint");
}

TEST(DescribeInputsTest, AShellReadsTheSameAgain) {
  EXPECT_EQ(Describe({.files = {"my suites/night.yaml", "b.yaml"},
                      .systems = {"robust", "paper"},
                      .set = {"mine.words=it's on", "robust.feature.features=800"},
                      .seeds = 3}),
            "'my suites/night.yaml' b.yaml --systems robust,paper --seeds 3 "
            "--set 'mine.words=it'\\''s on' --set robust.feature.features=800");
}

TEST_F(InputsTest, SetOptionsMayNeedEachOtherInAnyOrder) {
  const std::vector<Suite> suites = LoadInputs(
      {.files = {second_}, .set = {"robust.orbslam2.map_ratio=0.7", "robust.base=orbslam2"}});
  EXPECT_EQ(suites[0].systems[0].options.at("base"), "orbslam2");
}

TEST_F(InputsTest, SetTellsASystemOfOthersHowToSteerAndNothingElse) {
  const std::string mine =
      Write("m",
            "suite: m\nscenes: [a/one]\nseeds: 1\nsystems:\n  - {name: mine, contract: stream, "
            "command: slam}\n  - {name: files, command: 'slam {dataset} {output}'}\n");
  const std::vector<Suite> suites =
      LoadInputs({.files = {mine}, .set = {"mine.drive.latency_ms=100"}});
  EXPECT_EQ(suites[0].systems[0].options.at("drive.latency_ms"), "100");
  EXPECT_THAT(Complaint({.files = {mine}, .set = {"mine.drive.latency_ms=-1"}}), HasSubstr("-1"));
  EXPECT_THAT(Complaint({.files = {mine}, .set = {"mine.features=9"}}),
              HasSubstr("in its command line"));
  EXPECT_THAT(Complaint({.files = {mine}, .set = {"files.drive.latency_ms=9"}}),
              HasSubstr("in its command line"));
}

TEST_F(InputsTest, SetSaysWhatIsWrong) {
  const std::pair<const char*, const char*> cases[] = {
      {"robust.orbslam2.map_ratio=0.7",
       "--set, system 'robust': orbslam2.map_ratio has no effect with base plain"},
      {"robust.feature.features", "expected PATH=VALUE"},
      {"robust.feature.featurs=800", "feature.features"},
      {"robust.feature.features=many", "many"},
      {"paper.feature.features=800", "expected SYSTEM.PATH=VALUE with one of robust"},
  };
  for (const auto& [text, expected] : cases) {
    EXPECT_THAT(Complaint({.files = {second_}, .set = {text}}), HasSubstr(expected)) << text;
  }
}

TEST_F(InputsTest, WhoKeepsNoMapThatIsKnownHereCannotBeTaught) {
  const auto with = [&](const std::string& options) {
    return Write("t", "suite: t\nscenes: [a/one]\nseeds: 1\nsystems:\n  - {name: mine, contract: " +
                          ("stream, command: slam, options: {" + options + "}}\n"));
  };
  EXPECT_EQ(LoadInputs({.files = {with("drive.latency_ms: 20")}}).size(), 1u);
  EXPECT_THAT(Complaint({.files = {with("drive.taught: true")}}),
              HasSubstr("only built-in systems can be taught"));
  EXPECT_THAT(
      Complaint({.files = {with("drive.scanner: true")}, .set = {"mine.drive.taught=true"}}),
      HasSubstr("only built-in systems can be taught"));
  EXPECT_THAT(
      Complaint({.files = {second_},
                 .set = {"robust.drive.taught=true", "robust.drive.steered_by_truth=true"}}),
      HasSubstr("set one of them to false"));
}

TEST_F(InputsTest, AVariantOfASuiteMayBeChosenByName) {
  const std::string file =
      Write("v",
            "suite: v\nscenes: [a/one]\nseeds: 1\nsystems: [robust, {name: fast, like: robust, "
            "options: {feature.features: 500}}]\n");
  const std::vector<Suite> suites = LoadInputs({.files = {file}, .systems = {"fast", "oracle"}});
  ASSERT_EQ(suites[0].systems.size(), 2u);
  EXPECT_EQ(suites[0].systems[0].options.at("feature.features"), "500");
  EXPECT_EQ(suites[0].systems[1], BuiltIn("oracle"));
}

TEST_F(InputsTest, ALimitOnAScoreThatDoesNotExistIsAMistakeOfTheFile) {
  EXPECT_THAT(Complaint({.files = {Write("l",
                                         "suite: l\nscenes: [a/one]\nsystems: [oracle]\n"
                                         "limits: [{score: ate_rms_m, max: 1}]\n")}}),
              HasSubstr("unknown score 'ate_rms_m' (did you mean ate_rmse_m?)"));
}

TEST_F(InputsTest, LimitsGoWithWhatTheUserLeavesOut) {
  const std::string file =
      Write("m",
            "suite: m\nscenes: [a/one]\nsystems: [plain, oracle]\ntwins: [live, empty]\nseeds: 1\n"
            "limits:\n"
            "  - {score: ate_rmse_m, system: plain, max: 1}\n"
            "  - {score: ate_rmse_m, system: oracle, twin: empty, max: 2}\n"
            "  - {score: ate_rmse_m, max: 3}\n"
            "  - {score: dynamic_penalty, twin: live, system: plain, max: 4}\n");
  const auto bounds = [&](const InputOptions& options) {
    const Suite suite = LoadInputs(options).front();
    EXPECT_EQ(suite.limits.size() + suite.limits_left_out, 4u);
    std::vector<double> most;
    for (const Limit& limit : suite.limits) most.push_back(*limit.max);
    return most;
  };
  EXPECT_THAT(bounds({.files = {file}}), testing::ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(bounds({.files = {file}, .twins = {"live"}}), testing::ElementsAre(1, 3));
  EXPECT_THAT(bounds({.files = {file}, .systems = {"plain"}}), testing::ElementsAre(1, 3, 4));
  EXPECT_THAT(bounds({.files = {file}, .systems = {"robust"}}), testing::ElementsAre(3));
  EXPECT_THAT(bounds({.files = {file}, .seeds = 3}), testing::ElementsAre(1, 2, 3, 4));
}

}  // namespace
}  // namespace aisle
