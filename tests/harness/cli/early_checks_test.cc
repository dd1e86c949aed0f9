// What a command is told wrongly is said before the work begins, not when it is done.
#include "harness/cli/early_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "tests/harness/cli/exit.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class EarlyChecksTest : public testing::Test {
 protected:
  EarlyChecksTest() { fs::create_directories(folder_); }
  ~EarlyChecksTest() override { fs::remove_all(folder_); }

  /// Refused as input, with these words.
  static void ExpectRefused(const std::vector<std::string>& words, const std::string& why) {
    std::string said;
    EXPECT_EQ(Exit(words, &said), kBadInput) << testing::PrintToString(words);
    EXPECT_THAT(said, HasSubstr(why)) << testing::PrintToString(words);
  }

  const fs::path folder_ = fs::temp_directory_path() / fmt::format("aisle_early_{}", ::getpid());
};

/// What is wrong with the scenes; empty where nothing is.
std::string Complaints(const std::vector<std::string>& files) {
  try {
    CheckSceneFiles(files);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST_F(EarlyChecksTest, EveryMistakeOfEverySceneIsSaidOnce) {
  const std::string good = AISLE_SOURCE_DIR "/scenes/smoke/bits.yaml";
  const std::string bad = (folder_ / "bad.yaml").string(), gone = (folder_ / "gone.yaml").string();
  WriteFileAtomically(bad, "frames: -1\nrate_hz: x\n");
  EXPECT_EQ(Complaints({good, good}), "");
  const std::string of_bad = Complaints({bad});
  EXPECT_THAT(of_bad, HasSubstr("bad.yaml:1:"));
  EXPECT_THAT(of_bad, HasSubstr("bad.yaml:2:"));
  EXPECT_EQ(Complaints({good, bad, gone, bad}), of_bad + "\n" + Complaints({gone}));
}

TEST_F(EarlyChecksTest, ScenesThatComeLaterAreLookedAtFirst) {
  const std::string out = (folder_ / "out").string();
  std::string said;
  EXPECT_EQ(Exit({"bench", "render", "smoke/bits", "smoke/bist", "--frames", "2"}, &said),
            kBadInput);
  EXPECT_THAT(said, HasSubstr("smoke/bist"));
  EXPECT_THAT(said, Not(HasSubstr("bare primary rays"))) << "nothing was measured";
  ExpectRefused({"bench", "light", "smoke/bits:0", "smoke/bist:0", "--out", out}, "smoke/bist");
  ExpectRefused({"bench", "light", "smoke/bits:0", "smoke/bits:8", "--out", out},
                "has frames 0 to 7, not 8");
  ExpectRefused({"bench", "light", "smoke/bits:0", "smoke/bits:x", "--out", out},
                "expected SCENE:FRAME");
  EXPECT_FALSE(fs::exists(fs::path(out) / "smoke_bits_0.png"));
  const std::string words = (folder_ / "words.voc").string();
  ExpectRefused({"vocabulary", "train", "smoke/bits", "smoke/bist", "--out", words}, "smoke/bist");
  ExpectRefused({"vocabulary", "train", "smoke/bits", "--twin", "lve", "--out", words}, "lve");
}

TEST_F(EarlyChecksTest, WhereAResultGoesIsAskedFirst) {
  ExpectRefused({"vocabulary", "train", "smoke/bits", "--out", folder_.string()},
                "is a folder; expected a file");
  for (const char* bench : {"accuracy", "dynamic", "render", "sensitivity", "slam"}) {
    std::string said;
    EXPECT_EQ(Exit({"bench", bench, "smoke/bits", "--json", folder_.string()}, &said), kBadInput);
    EXPECT_THAT(said, HasSubstr("is a folder; expected a file")) << bench;
    EXPECT_THAT(said, Not(HasSubstr("smoke/bits"))) << bench << " has measured nothing";
  }
}

TEST_F(EarlyChecksTest, AVocabularyIsTrainedFromScenesByName) {
  const std::string words = (folder_ / "words.voc").string();
  std::string said;
  EXPECT_EQ(Exit({"vocabulary", "train", "smoke/bits", "--frames", "2", "--out", words}, &said),
            kAllPassed)
      << said;
  EXPECT_TRUE(fs::exists(words));
}

TEST_F(EarlyChecksTest, WhatASceneOfAnotherRendererHasNoUseForIsRefused) {
  const std::string scene = (folder_ / "box.json").string();
  const std::vector<std::vector<std::string>> idle = {
      {"--into", "page.md"}, {"--next"}, {"--reduce", "4"}, {"--seed", "3"}};
  for (const std::vector<std::string>& more : idle) {
    std::vector<std::string> words = {"bench", "light", "--foreign", scene};
    words.insert(words.end(), more.begin(), more.end());
    ExpectRefused(words, "excludes");
  }
}

TEST_F(EarlyChecksTest, HowToSteerIsNotAskedOfWhoLooksOn) {
  const std::vector<std::vector<std::string>> commands = {
      {"slam", folder_.string(), "-o", (folder_ / "slam.txt").string()},
      {"bench", "accuracy", "smoke/bits"},
      {"bench", "dynamic", "smoke/bits"},
      {"bench", "sensitivity", "smoke/bits"},
      {"bench", "slam", "smoke/bits"}};
  for (std::vector<std::string> words : commands) {
    words.insert(words.end(), {"--set", "drive.latency_ms=50"});
    ExpectRefused(words, "drive.latency_ms: this command does not steer");
  }
}

TEST_F(EarlyChecksTest, ALimitWithoutANumberIsNone) {
  for (const char* limit : {"ate_rmse_m<=nan", "ate_rmse_m<=inf", "ate_rmse_m<=", "ate_rmse_m"}) {
    ExpectRefused({"bisect", "a", "b", (folder_ / "suite.yaml").string(), "--scene", "short",
                   "--limit", limit},
                  fmt::format("'ate_rmse_m<=0.03', got '{}'", limit));
  }
}

}  // namespace
}  // namespace aisle
