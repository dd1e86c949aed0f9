#include <gtest/gtest.h>

#include <array>
#include <set>

#include "slam/dynamic/common/counter_random.h"
#include "slam/dynamic/common/in_parallel.h"

namespace aisle::slam::dynamic {
namespace {

TEST(CounterRandom, IsAFunctionOfSeedStreamAndCounterAlone) {
  CounterRandom one(3, 7), same(3, 7), other_seed(4, 7), other_stream(3, 8);
  std::set<std::uint64_t> seen;
  for (int k = 0; k < 100; ++k) {
    const std::uint64_t drawn = one.Next();
    EXPECT_EQ(drawn, same.Next());
    seen.insert({drawn, other_seed.Next(), other_stream.Next()});
  }
  EXPECT_EQ(seen.size(), 300U);
}

TEST(CounterRandom, BelowIsEven) {
  constexpr int kDraws = 70000;
  std::array<int, 7> counts{};
  CounterRandom random(1, 2);
  for (int k = 0; k < kDraws; ++k) ++counts.at(static_cast<std::size_t>(random.Below(7)));
  double chi2 = 0;
  for (const int count : counts) {
    const double off = count - kDraws / 7.0;
    chi2 += off * off / (kDraws / 7.0);
  }
  EXPECT_LT(chi2, 22.46);  // 99.9 % of chi-square with six degrees of freedom
}

TEST(CounterRandom, DistinctIndicesAreDistinctAndAllOfThemWhereThereAreNoMore) {
  for (std::uint64_t stream = 0; stream < 50; ++stream) {
    const std::array<int, 5> drawn = CounterRandom(9, stream).Distinct<5>(5);
    EXPECT_EQ(std::set<int>(drawn.begin(), drawn.end()), (std::set{0, 1, 2, 3, 4}));
  }
}

TEST(InParallel, GivesBothValues) {
  const auto [number, text] = InParallel([] { return 7; }, [] { return std::string("seven"); });
  EXPECT_EQ(number, 7);
  EXPECT_EQ(text, "seven");
}

}  // namespace
}  // namespace aisle::slam::dynamic
