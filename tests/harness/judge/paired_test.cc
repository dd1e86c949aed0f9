#include "harness/judge/paired.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace aisle {
namespace {

/// Nine differences of this mean and the spread 1.
std::vector<double> Nine(double mean) {
  std::vector<double> nine = {-1, -1, -1, -1, 0, 1, 1, 1, 1};
  for (double& one : nine) one += mean;
  return nine;
}

TEST(StudentPTest, AgreesWithTheTables) {
  EXPECT_NEAR(StudentP(Nine(2.306 / 3)), 0.05, 1e-4);
  EXPECT_NEAR(StudentP(Nine(-3.355 / 3)), 0.01, 1e-5);
  EXPECT_NEAR(StudentP(Nine(5.041 / 3)), 0.001, 1e-6);
  EXPECT_EQ(StudentP(Nine(0)), 1);
  EXPECT_EQ(StudentP(std::vector<double>{7}), 1);
}

/// Of eight degrees of freedom the tail is a finite sum, whose digits cancel out where it is small.
TEST(StudentPTest, IsRightFarOutWhereDifferencesOfChancesAreNot) {
  for (const double t : {10.0, 30.0, 100.0}) {
    const double c = std::cos(std::atan(t / std::sqrt(8.0))), x = c * c;
    // 1 = s (1 + x / 2 + 3 x^2 / 8 + ...) with s the sine: what the finite sum leaves out.
    double rest = 0, term = 35.0 / 128 * std::pow(x, 4);
    for (int k = 4; k < 60; ++k, term *= x * (2 * k - 1) / (2.0 * k)) rest += term;
    EXPECT_NEAR(StudentP(Nine(t / 3)) / (std::sqrt(1 - x) * rest), 1, 1e-6) << t;
  }
}

TEST(StudentPTest, RatiosThatAreAlikeAreNoProofWithoutBound) {
  const std::vector<double> alike(9, std::log(1.2));
  EXPECT_GT(StudentP(alike), 1e-7);
  EXPECT_LT(StudentP(alike), 1e-4);
}

TEST(SignPTest, CountsThoseOnOneSide) {
  EXPECT_DOUBLE_EQ(SignP(std::vector<double>(9, 0.1)), 2.0 / 512);
  EXPECT_NEAR(SignP(std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, -90, 0, 0}), 20.0 / 512, 1e-12);
  EXPECT_EQ(SignP(std::vector<double>{1, -1}), 1);
  EXPECT_EQ(SignP(std::vector<double>{0, 0}), 1);
  EXPECT_EQ(SignP({}), 1);
}

TEST(SignedRankPTest, AgreesWithTheTables) {
  EXPECT_DOUBLE_EQ(SignedRankP(std::vector<double>(9, 0.1)), 2.0 / 512);
  // Ten, of which the first and the seventh in size are negative: 25 of 1024 ways reach so far.
  EXPECT_NEAR(SignedRankP(std::vector<double>{-1, 2, 3, 4, 5, 6, -7, 8, 9, 10, 0}), 50.0 / 1024,
              1e-12);
  EXPECT_EQ(SignedRankP(std::vector<double>{1, -1}), 1);
  EXPECT_EQ(SignedRankP({}), 1);
}

/// The normal distribution has the longer tail: beyond the limit p is a little too large.
TEST(SignedRankPTest, BeyondTheExactOnesIsNearThem) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> draw(0.3, 1);
  for (int i = 0; i < 20; ++i) {
    std::vector<double> sixty;
    for (int k = 0; k < 60; ++k) sixty.push_back(draw(random));
    const double exact = SignedRankP(sixty);
    sixty.push_back(1e-9);
    EXPECT_GT(SignedRankP(sixty), 0.9 * exact);
    EXPECT_LT(SignedRankP(sixty), 1.5 * exact + 1e-4);
  }
}

/// The differences of nine seeds that were drawn alike before and after, from distributions that
/// are normal and that are not: a p is small no oftener than it says.
TEST(PairedPTest, AreSmallNoOftenerThanTheySay) {
  constexpr int kNights = 20000;
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal(0, 0.3);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto draw = [&](int kind) {
    if (kind == 0) return normal(random);
    if (kind == 1) return uniform(random);
    if (kind == 2) return -std::log(uniform(random));  // a long tail
    if (kind == 3) return 0.1 * normal(random) + (uniform(random) < 1.0 / 9 ? std::log(2.0) : 0);
    return 0.1 * normal(random) + (uniform(random) < 0.5 ? 5 : 0);  // two kinds of drives
  };
  for (int kind = 0; kind < 5; ++kind) {
    int student = 0, sign = 0, ranks = 0;
    for (int night = 0; night < kNights; ++night) {
      std::vector<double> differences;
      for (int seed = 0; seed < 9; ++seed) {
        const double before = draw(kind);
        differences.push_back(draw(kind) - before);
      }
      student += StudentP(differences) < 0.001;
      sign += SignP(differences) < 0.01;
      ranks += SignedRankP(differences) < 0.01;
    }
    EXPECT_LE(student, 1.7 * kNights / 1000) << kind;  // 20 are expected, more than 34 in 500 tries
    EXPECT_LE(sign, 1.2 * kNights / 100) << kind;
    EXPECT_LE(ranks, 1.2 * kNights / 100) << kind;
  }
}

}  // namespace
}  // namespace aisle
