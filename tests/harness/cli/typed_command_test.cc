#include "harness/cli/typed_command.h"

#include <gtest/gtest.h>

namespace aisle {
namespace {

TEST(RepeatableCommand, SpeaksOfTheLauncherAndLeavesPlacesOut) {
  EXPECT_EQ(RepeatableCommand({"/somewhere/bin/aisle", "bench", "dynamic", "paper/scene2:9-13@4",
                               "--frames-dir", "/tmp/x", "--warm-up", "20", "--json=/tmp/y.json"}),
            "./aisle bench dynamic paper/scene2:9-13@4 --warm-up 20");
}

TEST(RepeatableCommand, KeepsWhatStandsBehindAFlag) {
  EXPECT_EQ(RepeatableCommand({"aisle", "gallery", "--shares", "--json", "scenes/paper_narrow",
                               "--into", "page.md#shares"}),
            "./aisle gallery --shares scenes/paper_narrow");
}

TEST(RepeatableCommand, SaysOnHowManyThreadsTimesWereMeasured) {
  EXPECT_EQ(RepeatableCommand({"aisle", "bench", "render", "--threads", "2", "--into", "page.md",
                               "paper/scene2"}),
            "./aisle bench render --threads 2 paper/scene2");
}

TEST(RepeatableCommand, QuotesWhatAShellWouldTakeApart) {
  EXPECT_EQ(RepeatableCommand({"aisle", "check", "my scene's.yaml", ""}),
            "./aisle check 'my scene'\\''s.yaml' ''");
}

TEST(TypedCommand, IsThatOfThisProcess) {
  EXPECT_TRUE(TypedCommand().starts_with("./aisle")) << TypedCommand();
}

}  // namespace
}  // namespace aisle
