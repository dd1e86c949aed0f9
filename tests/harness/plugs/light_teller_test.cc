#include "harness/plugs/light_teller.h"

#include <gtest/gtest.h>

#include <vector>

namespace aisle {
namespace {

using std::chrono::seconds;

TEST(LightTeller, SaysWhatIsAtWorkFromTheFirstAndHowLongItTakesOnceThatCanBeTold) {
  std::vector<std::string> told;
  LightTeller teller("hall", [&](const LightWork& work) { told.push_back(Describe(work)); });
  const LightTeller::Clock::time_point start{};
  teller.Tell("laying its points", 0, start);
  teller.Tell("direct light", 0.25, start + seconds(10));
  teller.Tell("reflected light", 0.5, start + seconds(100));
  const std::vector<std::string> expected = {"laying its points", "direct light, 25 %, 30 s left",
                                             "reflected light, 50 %, 1 min 40 s left"};
  EXPECT_EQ(told, expected);
}

TEST(LightTeller, WhatIsMetHalfDoneIsNotTakenForQuick) {
  std::vector<std::string> told;
  LightTeller teller("hall", [&](const LightWork& work) { told.push_back(Describe(work)); });
  const LightTeller::Clock::time_point start{};
  teller.Tell("another run solves it", 0.5, start);
  teller.Tell("another run solves it", 0.75, start + seconds(10));
  EXPECT_EQ(told.back(), "another run solves it, 75 %, 10 s left");
  teller.Tell("laying its points", 0, start + seconds(11));  // who died: all anew
  EXPECT_EQ(told.back(), "laying its points");
  teller.Tell("direct light", 0.5, start + seconds(21));
  EXPECT_EQ(told.back(), "direct light, 50 %, 10 s left");
}

/// What is read later, as in a log, gets a line now and then; who asked is told instead.
TEST(LightTeller, WhereThereIsNoTerminalALineComesNowAndThen) {
  testing::internal::CaptureStderr();
  LightTeller teller("hall", {});
  LightTeller asked("asked", [](const LightWork&) {});
  const LightTeller::Clock::time_point start{};
  for (int second = 0; second < 25; ++second) {
    teller.Tell("direct light", 0.02 * second, start + seconds(second));
    asked.Tell("direct light", 0.02 * second, start + seconds(second));
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "hall: solving its light: direct light, 20 %, 40 s left\n"
            "hall: solving its light: direct light, 40 %, 30 s left\n");
}

}  // namespace
}  // namespace aisle
