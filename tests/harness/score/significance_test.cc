#include "harness/score/significance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace aisle {
namespace {

TEST(MannWhitneyTest, AgreesWithPublishedExactValues) {
  // Complete separation of n and m values: p = 2 / C(n + m, n).
  EXPECT_NEAR(MannWhitneyP(std::vector<double>{1, 2, 3, 4, 5}, std::vector<double>{6, 7, 8, 9, 10}),
              2.0 / 252, 1e-12);
  EXPECT_NEAR(MannWhitneyP(std::vector<double>{1, 2, 3}, std::vector<double>{4, 5, 6}), 0.1, 1e-12);
  // U = 1 of 3 x 3: arrangements at least as far out are U in {0, 1, 8, 9}: 4 of 20.
  EXPECT_NEAR(MannWhitneyP(std::vector<double>{1, 2, 4}, std::vector<double>{3, 5, 6}), 0.2, 1e-12);
}

TEST(MannWhitneyTest, IsSymmetricAndOneForEqualSamples) {
  const std::vector<double> a = {1, 5, 2, 2, 9}, b = {3, 2, 8, 7};
  EXPECT_DOUBLE_EQ(MannWhitneyP(a, b), MannWhitneyP(b, a));
  EXPECT_DOUBLE_EQ(MannWhitneyP(a, a), 1);
  EXPECT_DOUBLE_EQ(MannWhitneyP(a, {}), 1);
  EXPECT_DOUBLE_EQ(MannWhitneyP(std::vector<double>(5, 2.0), std::vector<double>(5, 2.0)), 1);
}

TEST(MannWhitneyTest, ExactAndNormalAgreeWhereTheyMeet) {
  std::mt19937_64 random(7);
  std::vector<double> a, b;
  for (int i = 0; i < 30; ++i) {
    a.push_back(static_cast<double>(random() % 1000));
    b.push_back(static_cast<double>(random() % 1000) + 180);
  }
  const double exact = MannWhitneyP(a, b);
  b.push_back(b.back());  // one value more: the approximation takes over
  EXPECT_NEAR(MannWhitneyP(a, b), exact, 0.04);
}

TEST(HolmTest, AgreesWithAHandWorkedExample) {
  const std::vector<double> adjusted = HolmAdjusted(std::vector<double>{0.01, 0.04, 0.03, 0.005});
  const double expected[] = {0.03, 0.06, 0.06, 0.02};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(adjusted[i], expected[i], 1e-12);
}

TEST(BootstrapTest, TheIntervalHoldsTheMedianAndRepeats) {
  const std::vector<double> values = {5, 1, 4, 2, 3, 9, 7, 8, 6};
  const Interval interval = BootstrapMedian(values);
  EXPECT_LE(interval.low, 5);
  EXPECT_GE(interval.high, 5);
  EXPECT_LT(interval.high - interval.low, 8);
  EXPECT_EQ(BootstrapMedian(values).low, interval.low);
  EXPECT_EQ(BootstrapMedian(std::vector<double>{2}).high, 2);
}

double Choose(int n, int k) {
  return std::exp(std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0));
}

/// The median of a draw of n (odd) is at most the k-th of the sorted values where more than half of
/// the draws are: Bin(n, k / n) (Efron 1979, section 10).
TEST(BootstrapTest, FollowsTheExactDistributionOfADrawsMedian) {
  for (const int n : {3, 5, 9, 25}) {
    std::vector<double> values;  // 1 to n, in disorder
    for (int i = 0; i < n; ++i) values.push_back(1 + i * 7 % n);
    const auto chance_of_at_most = [&](int k) {
      double sum = 0;
      for (int hits = (n + 1) / 2; hits <= n; ++hits) {
        sum +=
            Choose(n, hits) * std::pow(k / double(n), hits) * std::pow(1 - k / double(n), n - hits);
      }
      return sum;
    };
    for (const double tail : {0.1, 0.3}) {
      int low = 1, high = 1;
      while (chance_of_at_most(low) < tail) ++low;
      while (chance_of_at_most(high) < 1 - tail) ++high;
      const Interval interval = BootstrapMedian(values, 1 - 2 * tail, 20'000);
      EXPECT_EQ(interval.low, low) << n;
      EXPECT_EQ(interval.high, high) << n;
    }
  }
}

TEST(BootstrapTest, ADrawOfTwoMayLieBetweenThem) {
  const std::vector<double> values = {2, 0};  // 0, 1 and 2 with one, two and one chance in four
  EXPECT_EQ(BootstrapMedian(values, 0.4).low, 1);
  EXPECT_EQ(BootstrapMedian(values, 0.4).high, 1);
  EXPECT_EQ(BootstrapMedian(values, 0.9).low, 0);
  EXPECT_EQ(BootstrapMedian(values, 0.9).high, 2);
  EXPECT_EQ(BootstrapMedian(std::vector<double>{4, 4, 4, 4}).low, 4);
}

TEST(FailureRateTest, ZeroFailuresStillLeaveABound) {
  // Without failures the bound is 1 - 0.05^(1/n).
  for (const std::size_t n : {5u, 10u, 59u}) {
    EXPECT_NEAR(FailureRateBound(0, n), 1 - std::pow(0.05, 1.0 / static_cast<double>(n)), 1e-9);
  }
  EXPECT_EQ(FailureRateBound(3, 3), 1);
}

}  // namespace
}  // namespace aisle
