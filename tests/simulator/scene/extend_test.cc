#include "simulator/scene/extend.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "simulator/scene/load.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* kBase = R"(about: A person crosses.
frames: 100
camera: {baseline_m: 0.2, focal_px: [400, 400]}
rig:
  start: [0, 0]
  camera_height_m: 0.8
  steps:
    - {go: [[8, 0]], speed_mps: 0.9}
hall: {from: [-5, -8], to: [20, 8], height_m: 6}
lights:
  - {rows: 2, per_row: 4, height_m: 5}
people:
  - name: walker
    start: [5, 1.5]
    steps:
      - {go: [[5, -1.5]], speed_mps: 1.2}
  - {name: other, start: [10, 3]}
)";

class ExtendTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("aisle_extend_" + std::to_string(::getpid()));
    fs::create_directories(folder_ / "narrow");
    Write("base.yaml", kBase);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  std::string PathOf(const std::string& name) const { return (folder_ / name).string(); }

  fs::path folder_;
};

TEST_F(ExtendTest, HoldsWhereTheSceneSaysNothing) {
  const Scene scene = LoadScene(Write("narrow/s.yaml",
                                      "extend: ../base.yaml\n"
                                      "about: Narrow.\n"
                                      "camera: {focal_px: [700, 700]}\n"
                                      "rig: {camera_height_m: 0.5}\n"
                                      "people: [{name: alone, start: [6, 2]}]\n"));
  EXPECT_EQ(scene.about, "Narrow.");
  EXPECT_EQ(scene.frames, 100);
  EXPECT_EQ(scene.camera.focal_px.x(), 700);
  EXPECT_EQ(scene.camera.baseline_m, 0.2);  // maps key by key
  ASSERT_EQ(scene.people.size(), 1u);       // lists whole
  EXPECT_EQ(scene.people[0].name, "alone");
  EXPECT_THAT(scene.files, ElementsAre(PathOf("narrow/s.yaml"), PathOf("base.yaml")));
  EXPECT_THAT(SceneFiles(PathOf("narrow/s.yaml")), testing::ElementsAreArray(scene.files));
}

TEST_F(ExtendTest, ReachesOverSeveralFilesAndTheNearestDecides) {
  Write("middle.yaml", "extend: base\nframes: 50\nrate_hz: 10\n");
  const Scene scene = LoadScene(Write("narrow/s.yaml", "extend: ../middle\nrate_hz: 30\n"));
  EXPECT_EQ(scene.frames, 50);
  EXPECT_EQ(scene.rate_hz, 30);
  EXPECT_EQ(scene.about, "A person crosses.");
}

TEST_F(ExtendTest, FindsTheProgramsScenesByNameAndWhatLiesBesideBeforeThem) {
  const std::string own = (fs::path(AISLE_SOURCE_DIR) / "scenes/paper/scene2.yaml").string();
  for (const char* name : {"paper/scene2", "paper/scene2.yaml"}) {
    const Scene scene =
        LoadScene(Write("s.yaml", std::string("extend: ") + name + "\nabout: Ours.\n"));
    EXPECT_THAT(scene.files, testing::Contains(own)) << name;
    EXPECT_EQ(scene.about, "Ours.");
    EXPECT_EQ(scene.frames, LoadScene(own).frames);
  }
  fs::create_directories(folder_ / "paper");
  Write("paper/scene2.yaml", kBase);
  EXPECT_THAT(LoadScene(PathOf("s.yaml")).files,
              ElementsAre(PathOf("s.yaml"), PathOf("paper/scene2.yaml")));
}

TEST_F(ExtendTest, MistakesAreReportedWhereTheyStand) {
  Write("bad.yaml", std::string(kBase) + "framess: 3\n");
  EXPECT_THAT(CheckScene(Write("s.yaml", "extend: bad\nframes: many\n")),
              ElementsAre(StartsWith(PathOf("s.yaml") + ":2:9: frames: expected an integer"),
                          StartsWith(PathOf("bad.yaml") + ":18:1: framess: unknown key")));
  // The walk is the base's, the hall that it leaves is this file's.
  const auto left = CheckScene(Write("t.yaml", "extend: base\nhall: {to: [20, 1]}\n"));
  ASSERT_FALSE(left.empty());
  for (const std::string& message : left) {
    EXPECT_THAT(message, StartsWith(PathOf("base.yaml") + ":")) << message;
  }
}

TEST_F(ExtendTest, BrokenYamlOfTheBaseIsNamedThere) {
  Write("bad.yaml", "frames: [1\n");
  const auto messages = CheckScene(Write("s.yaml", "extend: bad\n"));
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_THAT(messages[0], StartsWith(PathOf("bad.yaml") + ":"));
  EXPECT_THAT(messages[0], HasSubstr("not YAML"));
  Write("list.yaml", "[1, 2]\n");
  EXPECT_THAT(CheckScene(Write("s.yaml", "extend: list\n")),
              ElementsAre(StartsWith(PathOf("list.yaml") + ":1:1: expected a map")));
}

TEST_F(ExtendTest, CirclesAreRefused) {
  Write("b.yaml", "about: b\nextend: a\n");
  EXPECT_THAT(CheckScene(Write("a.yaml", "extend: b\n")),
              ElementsAre(PathOf("b.yaml") + ":2:9: extend: scenes extend each other in a " +
                          "cycle: " + PathOf("a.yaml") + ", " + PathOf("b.yaml") + ", " +
                          PathOf("a.yaml")));
  EXPECT_THAT(CheckScene(Write("self.yaml", "extend: narrow/../self\n")),
              ElementsAre(HasSubstr("in a cycle")));
}

TEST_F(ExtendTest, AFileThatIsNotThereIsSaidAtTheKey) {
  EXPECT_THAT(CheckScene(Write("s.yaml", "about: x\nextend: nothing\n")),
              ElementsAre(StartsWith(PathOf("s.yaml") + ":2:9: extend: " + PathOf("nothing.yaml") +
                                     ": no such file; example: extend: ")));
  for (const char* text : {"extend:\n", "extend: [a]\n", "extend: ''\n"}) {
    EXPECT_THAT(CheckScene(Write("s.yaml", text)),
                ElementsAre(HasSubstr("extend: expected a scene file")))
        << text;
  }
}

TEST_F(ExtendTest, WhatIsMissingInAllOfThemIsMissing) {
  Write("part.yaml", "frames: 9\n");
  const auto messages = CheckScene(Write("s.yaml", "extend: part\nabout: x\n"));
  EXPECT_THAT(messages, testing::Contains(StartsWith(PathOf("s.yaml") + ":1:1: rig: missing key")));
}

TEST(YamlTree, KnowsTextsFromNumbersByTheirQuotes) {
  const YamlValue tree = BuildYamlTree("a: '1'\nb: 1\nc: ~\n", 2);
  EXPECT_TRUE(tree.Find("a")->value.quoted);
  EXPECT_FALSE(tree.Find("b")->value.quoted);
  EXPECT_TRUE(tree.Find("c")->value.is_null());
  EXPECT_EQ(tree.Find("b")->value.mark.line, 2);
  EXPECT_EQ(tree.Find("b")->value.mark.column, 4);
  EXPECT_EQ(tree.Find("b")->mark.file, 2);
  EXPECT_EQ(tree.Find("d"), nullptr);
}

}  // namespace
}  // namespace aisle::sim
