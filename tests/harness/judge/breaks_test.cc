#include "harness/judge/breaks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace aisle {
namespace {

TEST(BreakPTest, OneSeedOfOneIsStudentsT) {
  // Mean 0, spread 1, nine values: the next is beyond t * sqrt(10 / 9) with the t of 8 degrees.
  const std::vector<double> before = {-1, -1, -1, -1, 0, 1, 1, 1, 1};
  const auto at = [&](double t) {
    return BreakP(before, std::vector<double>{t * std::sqrt(10.0 / 9)}, {});
  };
  EXPECT_NEAR(at(1.860), 0.05, 1e-4);
  EXPECT_NEAR(at(2.896), 0.01, 1e-5);
  EXPECT_NEAR(at(5.041), 0.0005, 1e-6);
}

TEST(BreakPTest, NothingBrokenOrNothingKnownSaysNothing) {
  EXPECT_EQ(BreakP(std::vector<double>{0, 1, 2}, {}, std::vector<double>{0, 1, 2}), 1);
  EXPECT_EQ(BreakP(std::vector<double>{0}, std::vector<double>{9}, {}), 1);
}

TEST(BreakPTest, MoreOfThemAndFartherIsLessLikely) {
  const std::vector<double> before = {-1, -1, -1, -1, 0, 1, 1, 1, 1};
  const auto p_of = [&](const std::vector<double>& broken) {
    return BreakP(before, broken, std::vector<double>(9 - broken.size()));
  };
  EXPECT_LT(p_of({4, 4}), p_of({4}));
  EXPECT_LT(p_of({8}), p_of({4}));
  EXPECT_LT(p_of({8}), 0.01);
}

/// A night on which every seed scatters more than before has changed, but no few of them broke.
TEST(BreakPTest, ScatterThatTheOthersShowTonightIsNoBreak) {
  const std::vector<double> before = {-0.1, -0.1, -0.1, -0.1, 0, 0.1, 0.1, 0.1, 0.1};
  const std::vector<double> calm(8, 0.0), wild = {-1, -1, -1, -1, 1, 1, 1, 1};
  EXPECT_LT(BreakP(before, std::vector<double>{2}, calm), 1e-4);
  EXPECT_GT(BreakP(before, std::vector<double>{2}, wild), 0.1);
}

/// Drawn alike, values are called broken no oftener than p says, whatever their number.
TEST(BreakPTest, IsSmallNoOftenerThanItSays) {
  constexpr int kNights = 4000;
  constexpr std::size_t kSeeds = 9;
  std::mt19937_64 random(3);
  std::normal_distribution<double> draw(0, 0.5);
  int below_tenth = 0, below_hundredth = 0;
  for (int night = 0; night < kNights; ++night) {
    std::vector<double> before, after;
    for (std::size_t i = 0; i < kSeeds; ++i) before.push_back(draw(random));
    for (std::size_t i = 0; i < kSeeds; ++i) after.push_back(draw(random));
    const double p = BreakP(before, after, {});
    below_tenth += p < 0.1;
    below_hundredth += p < 0.01;
  }
  EXPECT_LE(below_tenth, kNights / 10);
  EXPECT_LE(below_hundredth, kNights / 100);
  EXPECT_GE(below_tenth, kNights / 100) << "so careful that it never says anything";
}

}  // namespace
}  // namespace aisle
