#include "harness/cli/terminal.h"

#include <gtest/gtest.h>

#include "harness/io/duration.h"

namespace aisle {
namespace {

TEST(TerminalTest, DurationsAreRoundedToWhatPeopleRead) {
  EXPECT_EQ(Duration(0.4), "0 s");
  EXPECT_EQ(Duration(59.4), "59 s");
  EXPECT_EQ(Duration(59.5), "1 min 00 s");
  EXPECT_EQ(Duration(200), "3 min 20 s");
  EXPECT_EQ(Duration(3599.5), "1 h 00 min");
  EXPECT_EQ(Duration(3720), "1 h 02 min");
}

TEST(TerminalTest, LongTextsKeepTheirEnd) {
  EXPECT_EQ(Abridged("paper/scene1", 12), "paper/scene1");
  EXPECT_EQ(Abridged("paper/scene1", 7), "…scene1");
}

TEST(TerminalTest, WhereNobodyLooksThereIsNeitherColourNorProgress) {
  testing::internal::CaptureStdout();  // from here on both streams are files
  testing::internal::CaptureStderr();
  const bool color = StdoutHasColor();
  {
    ProgressLine line;
    line.Show("frame 1");
  }
  const std::string said =
      testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr();
  EXPECT_FALSE(color);
  EXPECT_EQ(said, "");
}

TEST(TerminalTest, InALogProgressIsALineAMinute) {
  testing::internal::CaptureStderr();
  {
    ProgressLine line;
    for (int second = 0; second < 150; ++second) {
      line.Show(fmt::format("at {} s", second),
                ProgressLine::Clock::time_point{} + std::chrono::seconds(second));
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "at 60 s\nat 120 s\n");
}

}  // namespace
}  // namespace aisle
