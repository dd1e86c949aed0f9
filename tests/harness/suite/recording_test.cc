#include "harness/suite/recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "harness/io/input_error.h"
#include "harness/suite/suite.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class RecordingSourceTest : public testing::Test {
 protected:
  RecordingSourceTest()
      : folder_(fs::temp_directory_path() / fmt::format("aisle_recording_{}", ::getpid())) {
    fs::create_directories(folder_);
  }
  ~RecordingSourceTest() override { fs::remove_all(folder_); }
  std::string Put(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  const fs::path folder_;
};

TEST_F(RecordingSourceTest, PathsAreMeantFromItsFolder) {
  const RecordingSource source = ReadRecordingSource(
      Put("a.yaml", "recording: x.mcap\ntopics: [/l, /r]\nbaseline_m: 0.1\ntruth: x.mcap:/odom\n"));
  EXPECT_EQ(source.path, (folder_ / "x.mcap").string());
  EXPECT_EQ(source.truth, (folder_ / "x.mcap:/odom").string());
  EXPECT_EQ(source.topics, (std::vector<std::string>{"/l", "/r"}));
  EXPECT_EQ(source.baseline_m, 0.1);
}

TEST_F(RecordingSourceTest, IsToldFromAScene) {
  EXPECT_TRUE(IsRecording("drive.mcap"));
  EXPECT_TRUE(IsRecording(Put("a.yaml", "recording: x\n")));
  EXPECT_FALSE(IsRecording(Put("b.yaml", "about: x\n")));
  EXPECT_FALSE(IsRecording(Put("c.yaml", "a: [\n"))) << "who opens it says what is wrong";
}

TEST_F(RecordingSourceTest, MistakesAreNamedWithTheirPlace) {
  try {
    ReadRecordingSource(Put("a.yaml", "recording: x\nformat: tum\ntopic: /l\n"));
    FAIL() << "tum and topic passed";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("a.yaml:2"));
    EXPECT_THAT(error.what(), HasSubstr("did you mean topics"));
  }
}

TEST(RecordedPlan, ARecordingIsDrivenOnceByWhoNeedsNoTruth) {
  Suite suite;
  suite.scenes = {{"scene", "s.yaml", false}, {"drive", "d.mcap", true}};
  suite.systems = {BuiltIn("plain"), BuiltIn("oracle")};
  suite.twins = {"empty", "frozen"};
  suite.seeds = {4, 5};
  std::size_t of_scene = 0;
  std::vector<RunSpec> of_drive;
  for (const RunSpec& spec : Plan(suite)) {
    if (spec.scene == "drive") {
      of_drive.push_back(spec);
    } else {
      ++of_scene;
    }
  }
  EXPECT_EQ(of_scene, 8u);
  ASSERT_EQ(of_drive.size(), 1u);
  EXPECT_EQ(of_drive[0].twin, "live");
  EXPECT_EQ(of_drive[0].seed, 4u);
  EXPECT_EQ(of_drive[0].system.name, "plain");
}

}  // namespace
}  // namespace aisle
