#include "harness/cli/search_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace aisle {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(FirstInTimeTest, IsTheBestOfThoseThatKeepTheLimit) {
  EXPECT_EQ(FirstInTime({2.5, 1.6, 0.9}, 1.67), 1u);
  EXPECT_EQ(FirstInTime({1.67}, 1.67), 0u);
  EXPECT_FALSE(FirstInTime({2.5, 1.7}, 1.67));
  EXPECT_FALSE(FirstInTime({}, 1.67));
}

TEST(SearchTableTest, ASetOverTheLimitIsNotCalledFound) {
  SearchReport report;
  report.time_limit = 1.67;
  report.trials.resize(2);
  EXPECT_THAT(ToMarkdown(report), HasSubstr("None was found"));
  EXPECT_THAT(ToMarkdown(report), Not(HasSubstr("Found: the best")));
  report.found = true;
  EXPECT_THAT(ToMarkdown(report),
              HasSubstr("Found: the best whose detector takes at most 1.67 times the tracking"));
}

}  // namespace
}  // namespace aisle
