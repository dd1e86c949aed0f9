#include "harness/bench/stages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace aisle {
namespace {

TEST(StageTimeTest, NothingMeasuredIsNothing) {
  EXPECT_EQ(StageTime{}.mean_ms(), 0);
  EXPECT_EQ(StageTime{}.quantile_ms(0.99), 0);
  EXPECT_TRUE(LatencyProfile({}).empty());
}

TEST(LatencyProfileTest, StandsForAllTimesInAnyOrder) {
  std::mt19937 random(3);
  std::exponential_distribution<double> long_tailed(0.1);
  StageTime time;
  for (int i = 0; i < 2000; ++i) time.ms.push_back(20 + long_tailed(random));
  const std::vector<double> profile = LatencyProfile(time, 20);
  ASSERT_EQ(profile.size(), 20u);
  EXPECT_TRUE(std::ranges::is_sorted(profile));
  // As many of the times are below each entry as its place says.
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const auto below = std::ranges::count_if(time.ms, [&](double ms) { return ms < profile[i]; });
    EXPECT_NEAR(static_cast<double>(below) / 2000, (static_cast<double>(i) + 0.5) / 20, 1e-3);
  }
  // The middles of equal parts have nearly the mean of all; what is missing is the longest tail.
  StageTime of_profile{profile};
  EXPECT_NEAR(of_profile.mean_ms(), time.mean_ms(), 0.03 * time.mean_ms());
  std::ranges::shuffle(time.ms, random);
  EXPECT_EQ(LatencyProfile(time, 20), profile);
}

}  // namespace
}  // namespace aisle
