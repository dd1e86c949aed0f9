#include "harness/cli/help_format.h"

#include <gmock/gmock.h>

#include <sstream>

namespace aisle {
namespace {

using testing::HasSubstr;

/// The help of a program with a long option and a command with a long description.
std::string HelpAt(std::size_t width) {
  CLI::App app{"a program"};
  app.formatter(std::make_shared<HelpFormat>(width));
  app.add_option("--frames", "Which frames to look at, from the first one on, counted from zero");
  CLI::App* command =
      app.add_subcommand("count", "Count the frames of a drive, one after the other");
  command->add_option("--to", "Last frame to count, itself included, or the last one of the drive");
  command->footer(
      "Example: program count --to 100 --and --a --long --line --to --be --copied --whole");
  return app.help() + command->help();
}

TEST(HelpFormatTest, DescriptionsEndAtTheTerminalsEdgeAndLoseNoWord) {
  std::istringstream lines(HelpAt(80));
  std::string joined;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("Example")) {
      EXPECT_LE(line.size(), 80U) << line;
    }
    joined += line.substr(std::min(line.find_first_not_of(' '), line.size())) + " ";
  }
  EXPECT_THAT(joined,
              HasSubstr("Which frames to look at, from the first one on, counted from zero"));
  EXPECT_THAT(joined, HasSubstr("Count the frames of a drive, one after the other"));
  EXPECT_THAT(joined,
              HasSubstr("Last frame to count, itself included, or the last one of the drive"));
  EXPECT_THAT(joined, HasSubstr("--line --to --be --copied --whole"));
}

TEST(HelpFormatTest, WrittenToAFileADescriptionIsOneLine) {
  EXPECT_THAT(HelpAt(0), HasSubstr("from the first one on, counted from zero\n"));
}

TEST(HelpFormatTest, ATerminalTooNarrowForBothColumnsStillShowsWords) {
  EXPECT_THAT(HelpAt(20), HasSubstr("Which frames to look at, from"));
}

}  // namespace
}  // namespace aisle
