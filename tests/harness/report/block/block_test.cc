#include "harness/report/block/block.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/io/input_error.h"

namespace aisle {
namespace {

using testing::HasSubstr;

const BlockPlace kPlace{.file = "page.md", .block = "views"};

std::string Marked(const std::string& between) {
  return "# Page\n\nBefore.\n<!-- begin views: slam/track simulator -->\n" + between +
         "<!-- end views -->\n\nAfter.\n";
}

std::string Complaint(const std::string& page, const BlockPlace& place = kPlace) {
  try {
    WithBlock(page, place, "new");
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(Block, ReplacesWhatStandsBetweenItsLinesAndNothingElse) {
  const std::string once = WithBlock(Marked("old\nolder\n"), kPlace, "new\n\n");
  EXPECT_EQ(once, Marked("\nnew\n\n"));
  EXPECT_EQ(WithBlock(once, kPlace, "new"), once);
}

TEST(Block, LeavesTheOtherBlocksOfThePage) {
  const std::string other = "<!-- begin more: slam -->\nkept\n<!-- end more -->\n";
  EXPECT_EQ(WithBlock(other + Marked("old\n"), kPlace, "new"), other + Marked("\nnew\n\n"));
}

TEST(Block, RefusesAPageWithoutItsPlace) {
  EXPECT_THAT(Complaint("# Page\n"), HasSubstr("page.md: the line '<!-- begin views:' is missing"));
  EXPECT_THAT(Complaint("<!-- begin views: slam -->\n"),
              HasSubstr("the line '<!-- end views -->' is missing"));
  EXPECT_THAT(Complaint(Marked("") + Marked("")), HasSubstr("is there twice"));
  EXPECT_THAT(Complaint("<!-- end views -->\n<!-- begin views: slam -->\n"),
              HasSubstr("must come before"));
  EXPECT_THAT(Complaint("in prose <!-- begin views: slam -->\n<!-- end views -->\n"),
              HasSubstr("is indented"));
}

TEST(Block, IsNamedAfterThePage) {
  EXPECT_EQ(ParseBlockPlace("reports/a.md", "views").block, "views");
  EXPECT_EQ(ParseBlockPlace("reports/a.md#ten", "views").file, "reports/a.md");
  EXPECT_EQ(ParseBlockPlace("reports/a.md#ten", "views").block, "ten");
  for (const char* wrong : {"a.md#", "a.md#two words", "#ten"}) {
    EXPECT_THROW(ParseBlockPlace(wrong, "views"), InputError) << wrong;
  }
}

TEST(Block, FootNamesCommandCommitMachineAndDay) {
  const Provenance from{
      .version = "1", .commit = "abc1234", .cpu = "Some CPU", .os = "", .threads = 2};
  EXPECT_EQ(BlockFoot(from, "./aisle bench light", "2026-11-23T01:02:03Z"),
            "`./aisle bench light`; commit abc1234, Some CPU, 2 threads, 2026-11-23.\n");
}

}  // namespace
}  // namespace aisle
