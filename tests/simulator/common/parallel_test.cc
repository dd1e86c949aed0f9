#include "simulator/common/parallel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <stdexcept>
#include <thread>
#include <vector>

namespace aisle::sim {
namespace {

TEST(ParallelForTest, EveryIndexComesOnceWithAnyNumberOfThreads) {
  for (const std::size_t threads : {1, 2, 7}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    std::vector<int> calls(1000, 0);
    ParallelFor(3, 1000, [&](int i) { ++calls[static_cast<std::size_t>(i)]; });
    for (std::size_t i = 0; i < calls.size(); ++i) EXPECT_EQ(calls[i], i >= 3 ? 1 : 0) << i;
  }
  ParallelFor(5, 5, [](int) { FAIL() << "there is no index"; });
}

TEST(ParallelForTest, WhatThePartsWroteIsThereAfterwards) {
  std::vector<std::vector<int>> rows(64);
  ParallelFor(std::size_t{0}, rows.size(),
              [&](std::size_t i) { rows[i].assign(i, static_cast<int>(i)); });
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_THAT(rows[i], testing::AllOf(testing::SizeIs(i), testing::Each(static_cast<int>(i))));
  }
}

TEST(ParallelForTest, WhatAPartThrowsArrives) {
  const auto fails = [](int i) {
    if (i == 40) throw std::runtime_error("forty");
  };
  EXPECT_THROW(ParallelFor(0, 100, fails), std::runtime_error);
}

TEST(IsolatedTest, DoesItsWorkAndThrowsWhatThatThrows) {
  int sum = 0;
  Isolated([&] {
    std::vector<int> parts(64);
    ParallelFor(0, 64, [&](int i) { parts[static_cast<std::size_t>(i)] = i; });
    for (const int part : parts) sum += part;
  });
  EXPECT_EQ(sum, 63 * 64 / 2);
  EXPECT_THROW(Isolated([] { throw std::runtime_error("isolated"); }), std::runtime_error);
}

TEST(ArenaTest, GivesWhatIsMadeInIt) {
  const Arena arena(3);
  std::vector<int> squares(100);
  arena.Execute([&] { ParallelFor(0, 100, [&](int i) { squares[std::size_t(i)] = i * i; }); });
  EXPECT_EQ(squares.back(), 99 * 99);
  const auto made = arena.Execute([] { return std::make_unique<int>(7); });
  EXPECT_EQ(*made, 7);
  EXPECT_THROW(arena.Execute([] { throw std::runtime_error("arena"); }), std::runtime_error);
}

// One place for many callers: what they want done is done by whom they do not know.
TEST(ArenaTest, WorkOfManyCallersArrives) {
  const Arena arena(1);
  std::vector<std::string> made(8);
  {
    std::vector<std::jthread> callers;
    for (std::size_t k = 0; k < made.size(); ++k) {
      callers.emplace_back([&arena, &text = made[k], k] {
        for (int i = 0; i < 50; ++i) {
          const std::string had = text;
          text = arena.Execute([&] { return had + static_cast<char>('a' + k); });
        }
      });
    }
  }
  for (std::size_t k = 0; k < made.size(); ++k) {
    EXPECT_EQ(made[k], std::string(50, static_cast<char>('a' + k)));
  }
}

#if defined(__SANITIZE_THREAD__)
// ThreadSanitizer is told what packaged libraries order; it must not overlook what nobody orders.
TEST(ParallelForDeathTest, RacesOfOurOwnAreReported) {
  const auto race = [] {
    int sum = 0;
    ParallelFor(0, 100000, [&](int i) { sum += i; });
    std::exit(sum == 0);
  };
  EXPECT_EXIT(race(), testing::ExitedWithCode(66), "data race");
}
#endif

}  // namespace
}  // namespace aisle::sim
