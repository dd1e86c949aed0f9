#include "harness/judge/onset.h"

#include <gtest/gtest.h>

namespace aisle {
namespace {

using Nights = std::vector<std::optional<double>>;

/// Thirty nights about 2 with a little scatter; from `since` on, times `factor`.
Nights Month(std::size_t since, double factor) {
  Nights nights;
  for (std::size_t i = 0; i < 30; ++i) {
    nights.emplace_back((2 + 0.01 * static_cast<double>(i * 7 % 5)) * (i < since ? 1 : factor));
  }
  return nights;
}

TEST(OnsetTest, NamesTheFirstNightOfTheNewKind) {
  const auto onset = FindOnset(Month(12, 1.5));
  ASSERT_TRUE(onset.has_value());
  EXPECT_EQ(onset->night, 12u);
  EXPECT_NEAR(onset->before, 2.02, 0.02);
  EXPECT_NEAR(onset->after, 3.03, 0.03);
  EXPECT_EQ(FindOnset(Month(29, 0.5))->night, 29u);  // last night counts, and so does less
}

TEST(OnsetTest, ScatterAndABadNightThatStayedAloneAreNoNews) {
  EXPECT_FALSE(FindOnset(Month(30, 1)).has_value());
  Nights alone = Month(30, 1);
  alone[15] = 9.0;
  EXPECT_FALSE(FindOnset(alone).has_value());
  Nights mended = Month(12, 1.5);
  mended.back() = 2.0;
  EXPECT_EQ(FindOnset(mended)->night, 29u);              // better since last night is news
  EXPECT_FALSE(FindOnset(Month(12, 1.05)).has_value());  // a twentieth is nobody's trouble
  EXPECT_FALSE(FindOnset({1.0, 1.0, 5.0}).has_value());  // two nights know nothing
}

TEST(OnsetTest, NightsWithoutAValueArePassedOver) {
  Nights nights = Month(12, 1.5);
  nights[5] = nights[12] = std::nullopt;
  EXPECT_EQ(FindOnset(nights)->night, 13u);
}

TEST(OnsetTest, FailuresCountFromTheFirstOfTheLastRow) {
  EXPECT_EQ(FailingSince({false, true, false, true, true}), 3u);
  EXPECT_EQ(FailingSince({true, true}), 0u);
  EXPECT_FALSE(FailingSince({true, false}).has_value());
  EXPECT_FALSE(FailingSince({}).has_value());
}

}  // namespace
}  // namespace aisle
