#include "harness/report/paper/spread.h"

#include <gtest/gtest.h>

namespace aisle {
namespace {

std::string Tenths(double value) { return fmt::format("{:.1f}", value); }

TEST(SpreadTest, FewSeedsShowTheirRangeManyTheIntervalOfTheirMedianToo) {
  EXPECT_EQ(SpreadText({3, 1, 2}, Tenths), "1.0–3.0");
  EXPECT_EQ(SpreadRowName(3, "paper/scene2"), "3 seeds, least–most: paper/scene2");
  // Eight alike and one astray: the median is as sure as can be, the worst shows all the same.
  EXPECT_EQ(SpreadText({2, 2, 2, 2, 90, 2, 2, 2, 2}, Tenths), "2.0 [2.0–2.0] 90.0");
  EXPECT_EQ(SpreadRowName(9, "s"), "9 seeds, least [95 % of the median] most: s");
}

TEST(SpreadTest, BesideAMedianStandsItsIntervalOrTheRangeOfFewSeeds) {
  EXPECT_EQ(IntervalText({7}, Tenths), "");
  EXPECT_EQ(IntervalText({3, 1, 2}, Tenths), "(1.0 to 3.0)");
  EXPECT_EQ(IntervalText({2, 2, 2, 2, 90, 2, 2, 2, 2}, Tenths), "[2.0, 2.0]");
  EXPECT_FALSE(HasInterval(4));
  EXPECT_TRUE(HasInterval(5));
}

TEST(SpreadTest, TheIntervalIsThatOfTheSpread) {
  const std::vector<double> values = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  std::string within = SpreadText(values, Tenths);
  within = within.substr(within.find('['), within.find(']') + 1 - within.find('['));
  within.replace(within.find("–"), std::string("–").size(), ", ");
  EXPECT_EQ(IntervalText(values, Tenths), within);
}

TEST(SpreadTest, TheIntervalLiesWithinTheRangeAroundTheMedian) {
  const std::string text = SpreadText({1, 2, 3, 4, 5, 6, 7, 8, 9}, Tenths);
  double least = 0, low = 0, high = 0, most = 0;
  ASSERT_EQ(std::sscanf(text.c_str(), "%lf [%lf–%lf] %lf", &least, &low, &high, &most), 4) << text;
  EXPECT_EQ(least, 1);
  EXPECT_EQ(most, 9);
  // Order statistics: the second and the eighth of nine hold the median with 96 %.
  EXPECT_GE(low, 2);
  EXPECT_LT(low, 5);
  EXPECT_GT(high, 5);
  EXPECT_LE(high, 8);
}

}  // namespace
}  // namespace aisle
