// What people and programs hold on to: help with examples, answers in JSON, completion.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "harness/io/file.h"
#include "harness/io/image.h"
#include "tests/system/program.h"

namespace aisle {
namespace {

using testing::HasSubstr;
using testing::Not;

class CommandLineTest : public ProgramTest {
 protected:
  static nlohmann::json Answer(std::vector<std::string> arguments, int code) {
    arguments.push_back("--json");
    const Said said = Run(arguments);
    EXPECT_EQ(said.code, code) << said.text;
    return nlohmann::json::parse(said.text.substr(said.text.find('{')));  // stderr comes first
  }
};

TEST_F(CommandLineTest, EveryCommandExplainsItselfByAnExample) {
  for (const char* command :
       {"run", "rerun", "merge", "preview", "gallery", "render", "slam", "vocabulary", "score",
        "report", "compare", "baseline", "bisect", "check", "doctor", "completion"}) {
    const Said said = Run({command, "--help"});
    EXPECT_EQ(said.code, 0) << command;
    EXPECT_THAT(said.text, HasSubstr(std::string("Example: "))) << command;
  }
}

TEST_F(CommandLineTest, ProgramsAreAnsweredInJson) {
  WriteFileAtomically(folder_ / "bad.yaml", "suite: 3\nscenes: x\n");
  const nlohmann::json checked =
      Answer({"check", scene_, (folder_ / "bad.yaml").string()}, 4).at("files");
  EXPECT_TRUE(checked.at(0).at("good"));
  EXPECT_FALSE(checked.at(1).at("good"));
  EXPECT_THAT(checked.at(1).at("complaints").at(0).get<std::string>(), HasSubstr("bad.yaml:"));
  const std::string guest = (folder_ / "guest.yaml").string();
  WriteFileAtomically(guest,
                      "suite: g\nscenes: " + scene_ +
                          "\nsystems: [{name: mine, command: './not_built_yet {output}'}]\n");
  const nlohmann::json warned = Answer({"check", guest}, 0).at("files").at(0);
  EXPECT_THAT(warned.at("notes").at(0).get<std::string>(), HasSubstr("not_built_yet"));

  const std::string begin = "0 0 0 0 0 0 0 1\n", end = "2 2 1 0 0 0 0 1\n3 3 0 0 0 0 0 1\n";
  WriteFileAtomically(folder_ / "t.txt", begin + "1 1 0 0 0 0 0 1\n" + end);
  WriteFileAtomically(folder_ / "e.txt", begin + end);
  const nlohmann::json scored = Answer({"score", "--truth", (folder_ / "t.txt").string(),
                                        "--estimate", (folder_ / "e.txt").string(), "--rate", "1"},
                                       0);
  EXPECT_NEAR(scored.at("scores").at("coverage").at("value").get<double>(), 3.0 / 4, 1e-12);

  ASSERT_EQ(Run({"run", Suite("json", "  - plain\n"), "--out", Out("a")}).code, 0);
  EXPECT_EQ(Answer({"report", Out("a")}, 0).at("runs").size(), 1u);
  const nlohmann::json again = Answer({"rerun", "short/live/plain/1", "--in", Out("a")}, 0);
  EXPECT_TRUE(again.at("compared"));
  EXPECT_TRUE(again.at("differences").empty());
  EXPECT_FALSE(Answer({"compare", Out("a"), Out("a")}, 0).at("comparisons").empty());
}

TEST_F(CommandLineTest, SteeringIsAskedOfScenesWithADriveAlone) {
  const std::string suite = (folder_ / "steer.yaml").string();
  WriteFileAtomically(suite, "suite: steer\nscenes: " + scene_ +
                                 "\nsystems: plain\nlatencies_ms: [0, 100]\n"
                                 "limits: [{score: docking_error_m, max: 1}]\n");
  for (const char* command : {"check", "run"}) {
    const Said said = Run({command, suite});
    EXPECT_EQ(said.code, 4);
    EXPECT_THAT(said.text, HasSubstr("a limit on docking_error_m needs a scene with a `drive`"));
    EXPECT_THAT(said.text, HasSubstr("drive.latency_ms of 'plain_100ms' needs"));
  }
  EXPECT_THAT(Run({"run", scene_, "--set", "plain.drive.taught=true", "--dry-run"}).text,
              HasSubstr("drive.taught of 'plain' needs"));
}

TEST_F(CommandLineTest, FilesOfOtherToolsAreToldOnce) {
  const std::filesystem::path data = folder_ / "data";
  WriteFileAtomically(data / "tracker.yaml", "klt_win_size: 24\nklt_max_iter: 30\n");
  WriteFileAtomically(data / "no_name.yaml", "scenes: " + scene_ + "\nsystems: plain\n");
  const Said folder = Run({"check", data.string()});
  EXPECT_EQ(folder.code, 4);
  EXPECT_THAT(folder.text, HasSubstr("skipped files that are neither scene, suite nor recording"));
  EXPECT_THAT(folder.text, HasSubstr("suite: missing key"));
  EXPECT_THAT(folder.text, Not(HasSubstr("unknown key")));
  for (const char* command : {"check", "run"}) {
    const Said file = Run({command, (data / "tracker.yaml").string()});
    EXPECT_EQ(file.code, 4);
    EXPECT_THAT(file.text, HasSubstr("tracker.yaml:1: neither a scene, a suite nor a recording"));
  }
}

cv::Mat1b Square(int x, int y) {
  cv::Mat1b mask(120, 160, static_cast<unsigned char>(0));
  mask(cv::Rect(x, y, 40, 40)) = 255;
  return mask;
}

TEST_F(CommandLineTest, MasksOfOthersGetTheScoresThatAHandWouldReckon) {
  // First image: ten pixels beside the truth. Second: missed, and something invented elsewhere.
  for (const auto& [name, truth, mask] : {std::tuple("1.png", Square(10, 10), Square(20, 10)),
                                          std::tuple("2.png", Square(10, 10), Square(100, 60))}) {
    WriteImage(folder_ / "truth" / name, truth);
    WriteImage(folder_ / "masks" / name, mask);
  }
  const nlohmann::json scores = Answer({"score", "--masks-truth", (folder_ / "truth").string(),
                                        "--masks", (folder_ / "masks").string()},
                                       0)
                                    .at("scores");
  const auto value = [&](const char* name) { return scores.at(name).at("value").get<double>(); };
  EXPECT_DOUBLE_EQ(value("object_precision"), 1.0 / 2);
  EXPECT_DOUBLE_EQ(value("object_recall"), 1.0 / 2);
  EXPECT_DOUBLE_EQ(value("object_iou"), 1200.0 / 2000);
  EXPECT_DOUBLE_EQ(value("mask_precision"), 1200.0 / 3200);
  EXPECT_DOUBLE_EQ(value("mask_recall"), 1200.0 / 3200);
  EXPECT_DOUBLE_EQ(value("mask_iou"), 1200.0 / 5200);
}

TEST_F(CommandLineTest, OutlinesMeetWithinAShareOfTheDiagonal) {
  // A square that is two pixels off: 0.008 of the diagonal of 160 x 120 are 1.6, rounded up.
  const std::pair<int, double> shifts[] = {{2, 1}, {40, 0}};
  for (const auto& [shift, f] : shifts) {
    WriteImage(folder_ / "truth/1.png", Square(10, 40));
    WriteImage(folder_ / "masks/1.png", Square(10 + shift, 40 + shift));
    const nlohmann::json scores =
        Answer({"score", "--masks-truth", (folder_ / "truth").string(), "--masks",
                (folder_ / "masks").string(), "--boundary-davis"},
               0)
            .at("scores");
    EXPECT_NEAR(scores.at("mask_boundary_f").at("value").get<double>(), f, 0.05) << shift;
  }
}

TEST_F(CommandLineTest, TrajectoriesAndMasksTogetherAreOneDocument) {
  std::string poses;
  for (int i = 0; i < 20; ++i) poses += fmt::format("{} {} {} 0 0 0 0 1\n", i, 0.1 * i, 0.01 * i);
  WriteFileAtomically(folder_ / "truth.txt", poses);
  for (const char* side : {"truth", "masks"}) {
    WriteImage(folder_ / side / "1.png", Square(10, 40));
  }
  const std::string file = (folder_ / "truth.txt").string();
  const std::vector<std::string> masks = {"--masks-truth", (folder_ / "truth").string(), "--masks",
                                          (folder_ / "masks").string()};
  std::vector<std::string> both = {"score", "--truth", file, "--estimate", file};
  both.insert(both.end(), masks.begin(), masks.end());
  const nlohmann::json json = Answer(both, 0);
  EXPECT_TRUE(json.at("scores").contains("ate_rmse_m"));
  EXPECT_EQ(json.at("masks").at("scores").at("mask_iou").at("value").get<double>(), 1);
}

TEST_F(CommandLineTest, AYawIsAlignedAwayAndATiltIsNot) {
  std::string truth, yawed, tilted;
  for (int i = 0; i < 20; ++i) {
    const double x = 0.1 * i, y = 0.01 * i * i;
    truth += fmt::format("{} {} {} 0 0 0 0 1\n", i, x, y);
    yawed += fmt::format("{} {} {} 2 0 0 0.7071067811865476 0.7071067811865476\n", i, 3 - y, x);
    tilted += fmt::format("{} {} 0 {} 0.7071067811865476 0 0 0.7071067811865476\n", i, x, y);
  }
  for (const auto& [name, text] :
       {std::pair("t", truth), std::pair("y", yawed), std::pair("l", tilted)}) {
    WriteFileAtomically(folder_ / name, text);
  }
  const auto error = [&](const char* estimate, const char* align) {
    return Answer({"score", "--truth", (folder_ / "t").string(), "--estimate",
                   (folder_ / estimate).string(), "--align", align},
                  0)
        .at("scores")
        .at("ate_rmse_m")
        .at("value")
        .get<double>();
  };
  EXPECT_LT(error("y", "posyaw"), 1e-9);
  EXPECT_LT(error("l", "se3"), 1e-9);
  EXPECT_GT(error("l", "posyaw"), 0.1);
}

TEST_F(CommandLineTest, DrivesFromSeveralStartsDifferFromEachOtherButNotFromTheirRepetition) {
  const auto bench = [&](const std::string& json) {
    const Said said =
        Run({"bench", "accuracy", scene_ + ":1-9", "--starts", "2", "--step", "2", "--frames-dir",
             (folder_ / "frames").string(), "--json", (folder_ / json).string()});
    EXPECT_EQ(said.code, 0) << said.text;
    return nlohmann::json::parse(ReadFile(folder_ / json)).at(0);
  };
  const nlohmann::json rendered = bench("a.json"), stored = bench("b.json");
  EXPECT_EQ(rendered, stored);
  EXPECT_EQ(rendered.at("frames"), 8);
  const auto errors = rendered.at("ate_live_rmse_m").get<std::vector<double>>();
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_NE(errors[0], errors[1]);
  for (const double error : errors) EXPECT_LT(error, 0.02);
  EXPECT_EQ(rendered.at("frames_lost"), nlohmann::json({0.0, 0.0}));
}

TEST_F(CommandLineTest, WhatRenderingCostsIsWrittenForPrograms) {
  const std::string json = (folder_ / "render.json").string();
  const std::string page = (folder_ / "page.md").string();
  WriteFileAtomically(page, "# Cost\n<!-- begin cost: simulator -->\n<!-- end cost -->\n");
  const Said said = Run(
      {"bench", "render", scene_, "--frames", "3", "--seed", "2", "--json", json, "--into", page});
  ASSERT_EQ(said.code, 0) << said.text;
  EXPECT_THAT(ReadFile(page), HasSubstr("| scene | pair, ms | bare primary rays, ms | ratio |"));
  const nlohmann::json cost = nlohmann::json::parse(ReadFile(json)).at(0);
  EXPECT_EQ(cost.at("seed"), 2);
  EXPECT_GT(cost.at("bare_primary_ms").get<double>(), 0);
  EXPECT_GT(cost.at("pair_ms").get<double>(), cost.at("bare_primary_ms").get<double>());
  EXPECT_NEAR(cost.at("ratio").get<double>(),
              cost.at("pair_ms").get<double>() / cost.at("bare_primary_ms").get<double>(), 1e-9);
  for (const char* stage : {"pose", "trace", "truth", "sensor"}) {
    EXPECT_GE(cost.at("stage_ms").at(stage).get<double>(), 0) << stage;
  }
  EXPECT_THAT(Run({"bench", "light", "--help"}).text, HasSubstr("--seed"));
}

/// What was not measured is not told: neither frames beyond the drive nor a ratio to no reference.
TEST_F(CommandLineTest, BenchesTellOnlyWhatTheyMeasured) {
  for (const char* bench : {"slam", "dynamic"}) {
    const Said said = Run({"bench", bench, scene_ + ":900-950"});
    EXPECT_EQ(said.code, 4) << bench << said.text;
    EXPECT_THAT(said.text, HasSubstr("it ends before frame 950"));
    EXPECT_THAT(said.text, testing::Not(HasSubstr("warm-up")));
  }
  const std::string json = (folder_ / "slam.json").string();
  for (const char* laps : {"1", "2"}) {
    const Said said = Run({"bench", "slam", scene_, "--laps", laps, "--json", json});
    ASSERT_EQ(said.code, 0) << said.text;
    const nlohmann::json told = nlohmann::json::parse(ReadFile(json));
    EXPECT_EQ(told.contains("ratio"), std::string(laps) == "1");
    EXPECT_EQ(told.contains("reference_orb_ms"), told.contains("ratio"));
    const auto frames = told.at("frames").get<std::size_t>();
    EXPECT_EQ(told.at("frames_with").at("extract").get<std::size_t>(), frames);
    EXPECT_LT(told.at("frames_with").at("map").get<std::size_t>(), frames);
    EXPECT_EQ(told.at("frames_with").at("dynamic").get<std::size_t>(), 0u)
        << "plain rejects nothing";
  }
}

TEST_F(CommandLineTest, TheShellCompletesCommandsOptionsAndValues) {
  const std::string script = (folder_ / "complete.sh").string();
  WriteFileAtomically(script, Run({"completion", "bash"}).text + R"(
complete_line() { COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _aisle; echo "${COMPREPLY[*]}"; }
complete_line aisle rer
complete_line aisle bench ren
complete_line aisle run x.yaml --gat
complete_line aisle score --align si
complete_line aisle run x.yaml --systems orb
)");
  Process shell({"/bin/bash", script}, {});
  while (!shell.Poll()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(shell.result().log, "rerun\nrender\n--gate\nsim3\norbslam2\n");
}

}  // namespace
}  // namespace aisle
