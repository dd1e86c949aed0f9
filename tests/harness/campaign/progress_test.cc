#include "harness/campaign/progress.h"

#include <gtest/gtest.h>

#include <sstream>

namespace aisle {
namespace {

TEST(ProgressTest, WhatIsToldIsTakenAndOtherLinesAreNot) {
  testing::internal::CaptureStdout();
  TellStage("solving its light: 3 of 7");
  TellProgress(3, 10);
  std::istringstream told(testing::internal::GetCapturedStdout());
  Progress progress;
  for (std::string line; std::getline(told, line);) EXPECT_TRUE(TakeProgress(line, &progress));
  EXPECT_EQ(progress.done, 3);
  EXPECT_EQ(progress.total, 10);
  EXPECT_EQ(progress.stage, "solving its light: 3 of 7");
  for (const char* line :
       {"", "progress 4 5", "@progress", "@progress 4", "@stage", "at @stage x"}) {
    EXPECT_FALSE(TakeProgress(line, &progress)) << line;
  }
  EXPECT_EQ(progress.done, 3);
}

TEST(ProgressTest, ACountIsWithinItsTotalWhateverIsSaid) {
  const std::tuple<const char*, int, int> said[] = {
      {"@progress -5 10", 0, 10}, {"@progress 50 10", 10, 10}, {"@progress 5 -10", 0, 0}};
  for (const auto& [line, done, total] : said) {
    Progress progress;
    EXPECT_TRUE(TakeFrameCount(line, &progress)) << line;
    EXPECT_EQ(progress.done, done) << line;
    EXPECT_EQ(progress.total, total) << line;
  }
}

TEST(ProgressTest, AStageIsNoCount) {
  Progress progress;
  EXPECT_FALSE(TakeFrameCount("@stage solving", &progress));
  EXPECT_EQ(progress.stage, "");
}

}  // namespace
}  // namespace aisle
