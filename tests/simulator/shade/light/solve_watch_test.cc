#include "simulator/shade/light/solve_watch.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>

#include "simulator/common/parallel.h"

namespace aisle::sim {
namespace {

struct Told {
  std::string phase;
  double share;
};

TEST(SolveWatch, TellsEachPhaseAtOnceAndTheShareThatIsForeseenForIt) {
  std::vector<Told> told;
  SolveWatch watch(
      [&](const LightProgress& at) {
        told.push_back({at.phase, at.share});
      },
      {{"short", 1}, {"long", 3}});
  watch.Begin(10);
  watch.Add(10);
  watch.Begin(100);
  watch.Add(0);
  watch.End();
  ASSERT_GE(told.size(), 3u);
  EXPECT_EQ(told.front().phase, "short");
  EXPECT_EQ(told.front().share, 0);
  const auto second = std::ranges::find(told, "long", &Told::phase);
  ASSERT_NE(second, told.end());
  EXPECT_EQ(second->share, 0.25);
  EXPECT_EQ(told.back().share, 1);
}

TEST(SolveWatch, NeverGoesBackAndNeverBeyondTheWhole) {
  double last = 0;
  SolveWatch watch(
      [&](const LightProgress& at) {
        EXPECT_GE(at.share, last);
        EXPECT_LE(at.share, 1);
        last = at.share;
      },
      {{"a", 2}, {"b", 0}, {"c", 1}});
  for (int phase = 0; phase < 3; ++phase) {
    watch.Begin(100);
    ParallelFor(0, 300, [&](int) { watch.Add(1); });  // more than was said
  }
  watch.End();
  EXPECT_EQ(last, 1);
}

/// How a Ctrl-C in Python ends a solution: within a moment, from whatever thread was told.
TEST(SolveWatch, WhatIsThrownWhenItTellsEndsTheWork) {
  int calls = 0;
  SolveWatch watch(
      [&](const LightProgress&) {
        if (++calls > 1) throw std::runtime_error("enough");
      },
      {{"endless", 1}});
  watch.Begin(1'000'000);
  EXPECT_THROW(ParallelFor(0, 1'000'000,
                           [&](int) {
                             std::this_thread::sleep_for(std::chrono::milliseconds(1));
                             watch.Add(1);
                           }),
               std::runtime_error);
}

}  // namespace
}  // namespace aisle::sim
