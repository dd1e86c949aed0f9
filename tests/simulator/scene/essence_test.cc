#include "simulator/scene/essence.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "simulator/scene/load.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScene = R"(about: A person crosses.
frames: 100
rig: {start: [0, 0], steps: [{go: [[8, 0]], speed_mps: 0.9}]}
hall: {from: [-5, -8], to: [20, 8], height_m: 6}
people:
  - {name: walker, start: [5, 1.5]}
)";

class EssenceTest : public testing::Test {
 protected:
  EssenceTest() { fs::create_directories(folder_); }
  ~EssenceTest() override { fs::remove_all(folder_); }

  std::string Of(const std::string& text, bool with_actors, const std::string& name = "a.yaml") {
    std::ofstream(folder_ / name) << text;
    return EssenceOf(folder_ / name, with_actors);
  }
  static std::string With(const std::string& what, const std::string& instead) {
    std::string text = kScene;
    return text.replace(text.find(what), what.size(), instead);
  }

  const fs::path folder_ = fs::temp_directory_path() / fmt::format("aisle_essence_{}", ::getpid());
};

TEST_F(EssenceTest, NeitherNamesNorWordsNorOrderCount) {
  const std::string own = Of(kScene, true);
  EXPECT_EQ(Of(kScene, true, "another.yaml"), own);
  EXPECT_EQ(Of(With("A person crosses.", "Something else."), true), own);
  EXPECT_EQ(Of("# a remark\n" + With("frames: 100\n", "") + "frames: 100\n", true), own);
  EXPECT_EQ(Of(With("[-5, -8]", "[ -5,  -8 ]"), true), own);
}

TEST_F(EssenceTest, WhatCanBeSeenCounts) {
  const std::string own = Of(kScene, true);
  for (const auto& [what, instead] : std::map<std::string, std::string>{
           {"0.9", "0.8"}, {"100", "101"}, {"height_m: 6", "height_m: 7"}, {"1.5", "1.6"}}) {
    EXPECT_NE(Of(With(what, instead), true), own) << what;
  }
  EXPECT_NE(Of(With("[20, 8]", "[8, 20]"), true), own);
  EXPECT_NE(Of(With("[8, 0]", "[8, 0], [9, 0]"), true), own);
}

TEST_F(EssenceTest, WhoIsNotToBeSeenDoesNotCount) {
  const std::string empty = Of(kScene, false);
  EXPECT_EQ(Of(With("1.5", "1.6"), false), empty);
  EXPECT_EQ(Of(std::string(kScene) + "vehicles:\n  - {name: v, start: [3, 3]}\n", false), empty);
  EXPECT_NE(Of(With("0.9", "0.8"), false), empty);
  EXPECT_NE(Of(kScene, true), empty);
}

TEST_F(EssenceTest, AnExtendedSceneIsWhatItAmountsTo) {
  Of(kScene, true, "base.yaml");
  EXPECT_EQ(Of("extend: base.yaml\nabout: It says more.\nframes: 101\n", true, "over.yaml"),
            Of(With("100", "101"), true));
}

TEST_F(EssenceTest, TheFilesOfARealRigCountByWhatTheyHold) {
  const std::string scene = With("{start: [0, 0], steps: [{go: [[8, 0]], speed_mps: 0.9}]}",
                                 "{trajectory: way.txt, trajectory_of: vehicle}") +
                            "lights: [{rows: 2, per_row: 5, height_m: 5.5}]\n";
  const auto drive = [&](const char* way) {
    std::ofstream(folder_ / "way.txt") << way;
    return Of(scene, true);
  };
  const std::string own = drive("0 0 0 0 0 0 0 1\n5 2 0 0 0 0 0 1\n");
  ASSERT_EQ(LoadScene(folder_ / "a.yaml").files.size(), 2u);
  EXPECT_EQ(drive("0 0 0 0 0 0 0 1\n5 2 0 0 0 0 0 1\n"), own);
  EXPECT_NE(drive("0 0 0 0 0 0 0 1\n5 3 0 0 0 0 0 1\n"), own);
}

TEST_F(EssenceTest, AMeshOfTheUsersOwnCountsByItsBytes) {
  const std::string scene = With("height_m: 6", "height_m: 6, mesh: room.glb") +
                            "lights: [{rows: 2, per_row: 5, height_m: 5.5}]\n";
  const auto made_of = [&](const char* bytes) {
    std::ofstream(folder_ / "room.glb") << bytes;
    return Of(scene, true);
  };
  const std::string own = made_of("glTF a");
  EXPECT_EQ(made_of("glTF a"), own);
  EXPECT_NE(made_of("glTF b"), own);
}

TEST_F(EssenceTest, WhatCannotBeReadIsSaid) {
  EXPECT_THROW(EssenceOf(folder_ / "none.yaml", true), SceneError);
  EXPECT_THROW(Of("a: [", true), SceneError);
}

}  // namespace
}  // namespace aisle::sim
