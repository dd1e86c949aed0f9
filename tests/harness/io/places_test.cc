#include "harness/io/places.h"

#include <gtest/gtest.h>

#include <fstream>

namespace aisle {
namespace {

namespace fs = std::filesystem;

TEST(Places, OfAnInstalledProgramAreBesideIt) {
  const fs::path root = fs::path(testing::TempDir()) / "places";
  fs::create_directories(root / "usr/share/aisle/assets");
  const OwnPlace installed = FindOwnPlace(root / "usr/bin/aisle");
  EXPECT_EQ(installed.folder, root / "usr/share/aisle");
  EXPECT_TRUE(installed.installed);
  fs::remove_all(root);
}

TEST(Places, OfABuiltProgramAreItsTrees) {
  EXPECT_FALSE(IsInstalled());
  EXPECT_TRUE(fs::equivalent(OwnFolder(), AISLE_SOURCE_DIR));
  EXPECT_EQ(OwnCommand(), "./aisle");
  EXPECT_EQ(FindOwnPlace("/nowhere/at/all").folder, "");
}

TEST(SceneFileTest, FindsScenesAndSuitesByName) {
  const std::string scenes = ScenesDir().string();
  EXPECT_EQ(SceneFile("paper/scene2"), scenes + "/paper/scene2.yaml");
  EXPECT_EQ(SceneFile("smoke"), scenes + "/smoke");  // the folder of scenes comes before the suite
  EXPECT_EQ(SceneFile("quickstart"), scenes + "/suites/quickstart.yaml");
  EXPECT_EQ(SceneFile("suites/smoke"), scenes + "/suites/smoke.yaml");
}

TEST(SceneFileTest, LeavesAFileThatIsThereAndWhatIsUnknown) {
  EXPECT_EQ(SceneFile(AISLE_SOURCE_DIR "/README.md"), AISLE_SOURCE_DIR "/README.md");
  EXPECT_EQ(SceneFile("no/such/scene"), "no/such/scene");
  EXPECT_EQ(SceneFile(std::string(5000, 'x')), std::string(5000, 'x'));
  EXPECT_EQ(SceneFile(""), "");
}

}  // namespace
}  // namespace aisle
