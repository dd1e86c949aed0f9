#include "harness/campaign/folder_modes.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "harness/io/file.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

class FolderModesTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / fmt::format("aisle_modes_{}", ::getpid());
    WriteFileAtomically(folder_ / "out/runs/file", "text");
    fs::permissions(folder_ / "out/runs/file", kFileMode);
  }
  void TearDown() override { RemoveFolder(folder_); }
  static fs::perms ModeOf(const fs::path& path) { return fs::status(path).permissions(); }

  static constexpr fs::perms kFileMode = fs::perms::owner_read | fs::perms::group_read;
  fs::path folder_;
};

TEST_F(FolderModesTest, ArePutBackFromTheOutsideIn) {
  const fs::path out = folder_ / "out";
  const fs::perms before = ModeOf(out), before_runs = ModeOf(out / "runs");
  {
    const FolderModes modes({out / "runs/file", out / "runs", folder_ / "none/below"});
    for (int round = 0; round < 2; ++round) {
      for (const fs::path& path : {out / "runs/file", out / "runs", out}) {
        fs::permissions(path, fs::perms::none);
      }
      if (round == 0) modes.PutBack();
      EXPECT_EQ(ModeOf(out) == before, round == 0);
    }
  }
  EXPECT_EQ(ModeOf(out), before);
  EXPECT_EQ(ModeOf(out / "runs"), before_runs);
  EXPECT_EQ(ModeOf(out / "runs/file"), kFileMode);
}

TEST_F(FolderModesTest, WhatWasShutAlreadyIsOpenedForItsOwner) {
  for (const char* below : {"out/runs", "out"}) {
    fs::permissions(folder_ / below, fs::perms::none);
  }
  FolderModes modes({folder_ / "out"});
  modes.PutBack();
  EXPECT_EQ(ModeOf(folder_ / "out"), fs::perms::owner_all);
  modes.Add({folder_ / "out/runs"});
  modes.PutBack();
  EXPECT_EQ(ModeOf(folder_ / "out/runs"), fs::perms::owner_all);
}

TEST_F(FolderModesTest, WhatOneGivesBackNoOtherTakesAway) {
  const fs::path out = folder_ / "out";
  const fs::perms before = ModeOf(out);
  const FolderModes right({out});
  fs::permissions(out, fs::perms::owner_exec);
  const FolderModes late({out});
  for (const FolderModes* modes : {&right, &late, &right, &late}) modes->PutBack();
  EXPECT_EQ(ModeOf(out), before);
}

TEST_F(FolderModesTest, AroundThemOthersMayChangeWhatIsNotTheOwners) {
  const fs::path out = folder_ / "out", runs = out / "runs";
  const fs::perms before = ModeOf(runs);
  const FolderModes modes({runs});
  for (const fs::path& path : {out, runs}) fs::permissions(path, fs::perms::owner_all);
  modes.PutBack();
  EXPECT_EQ(ModeOf(out), fs::perms::owner_all);
  EXPECT_EQ(ModeOf(runs), before);
}

TEST_F(FolderModesTest, WhatIsGoneIsLeftAlone) {
  const FolderModes modes({folder_ / "out/runs/file"});
  fs::remove_all(folder_ / "out");
  modes.PutBack();
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
}  // namespace aisle
