#include "harness/cluster/scratch.h"

#include <gtest/gtest.h>

#include "harness/cluster/submission.h"
#include "harness/io/file.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

class ScratchTest : public testing::Test {
 protected:
  void SetUp() override {
    base_ = fs::path(testing::TempDir()) /
            testing::UnitTest::GetInstance()->current_test_info()->name();
    RemoveFolder(base_);
    fs::create_directories(base_);
  }
  void TearDown() override { RemoveFolder(base_); }

  fs::path base_;
};

TEST_F(ScratchTest, IsGoneWithItsTask) {
  fs::path folder;
  {
    const Scratch scratch(base_);
    folder = scratch.folder();
    WriteFileAtomically(folder / "runs" / "one", "1");
  }
  EXPECT_FALSE(fs::exists(folder));
}

TEST_F(ScratchTest, WhatAKilledTaskLeftIsTakenAwayAndNothingElse) {
  const Scratch held(base_);
  const fs::path dead = held.folder().parent_path() / "task-dead";
  WriteFileAtomically(dead / "runs" / "one", "1");
  WriteFileAtomically(held.cache() / "frames" / "one", "1");
  const Scratch next(base_);
  EXPECT_FALSE(fs::exists(dead));
  EXPECT_TRUE(fs::exists(held.folder()));
  EXPECT_TRUE(fs::exists(held.cache() / "frames" / "one"));
  EXPECT_NE(next.folder(), held.folder());
}

TEST_F(ScratchTest, SubmissionAndVerdictComeBackAndDamageIsAbsence) {
  EXPECT_FALSE(ReadSubmission(base_));
  const Submission submission{.id = "now-1", .arrays = {"3", "4"}, .merge = "5"};
  WriteSubmission(submission, base_);
  EXPECT_EQ(ReadSubmission(base_), submission);
  WriteVerdict({.submission = "now-1", .exit_code = 1}, base_);
  EXPECT_EQ(ReadVerdict(base_), (ClusterVerdict{"now-1", 1}));
  WriteFileAtomically(base_ / "cluster" / "verdict.json", "{\"submission\": ");
  EXPECT_FALSE(ReadVerdict(base_));
  const std::string deep = std::string(100, '[') + std::string(100, ']');
  WriteFileAtomically(base_ / "cluster" / "verdict.json",
                      "{\"submission\": \"now-1\", \"exit_code\": 0, \"more\": " + deep + "}");
  EXPECT_FALSE(ReadVerdict(base_)) << "nested deeper than any file of ours";
}

}  // namespace
}  // namespace aisle
