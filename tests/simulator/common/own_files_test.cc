#include "simulator/common/own_files.h"

#include <gtest/gtest.h>

#include <fstream>

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

class OwnFiles : public testing::Test {
 protected:
  fs::path root_ = fs::path(testing::TempDir()) / "own_files";

  void SetUp() override { fs::remove_all(root_); }
  void TearDown() override { fs::remove_all(root_); }

  void Touch(const fs::path& file, const std::string& text = "") {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text;
  }
};

TEST_F(OwnFiles, AnInstalledProgramHasThemBesideIt) {
  Touch("usr/share/aisle/assets/manifest.json");
  Touch("usr/libexec/aisle/reader");
  EXPECT_EQ(FindOwnFolder(root_ / "usr/bin/aisle"), root_ / "usr/share/aisle");
  EXPECT_EQ(FindOwnHelper(root_ / "usr/bin/aisle", "reader", "mesh/reader"),
            root_ / "usr/libexec/aisle/reader");
}

TEST_F(OwnFiles, ABuiltProgramHasThemInItsTree) {
  Touch("build/release/aisle-built-from", "/somewhere/tree\n");
  EXPECT_EQ(FindOwnFolder(root_ / "build/release/tests/a_test"), "/somewhere/tree");
  EXPECT_EQ(FindOwnHelper(root_ / "build/release/harness/cli/aisle", "reader", "mesh/reader"),
            root_ / "build/release/mesh/reader");
}

TEST_F(OwnFiles, AProgramOfOthersHasNone) {
  Touch("opt/other/bin/robot");
  EXPECT_EQ(FindOwnFolder(root_ / "opt/other/bin/robot"), "");
  EXPECT_EQ(FindOwnHelper(root_ / "opt/other/bin/robot", "reader", "mesh/reader"), "");
  EXPECT_EQ(FindOwnFolder("robot"), "");
}

TEST_F(OwnFiles, ThisTestWasBuiltInThisTree) {
  EXPECT_TRUE(fs::equivalent(FindOwnFolder(OwnFile()), AISLE_SOURCE_DIR));
}

}  // namespace
}  // namespace aisle::sim
