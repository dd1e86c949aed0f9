#include "harness/judge/bits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace aisle {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::StartsWith;

RunRecord Scored(double ate_m, double process_ms) {
  RunRecord run;
  run.output_hash = "0123";
  run.scores["ate_rmse_m"] = {
      .value = ate_m, .unit = "m", .alignment = "se3", .n = 9, .absent = ""};
  run.scores["ms_process_mean"] = {
      .value = process_ms, .unit = "ms", .alignment = "", .n = 9, .absent = ""};
  return run;
}

TEST(BitsTest, TimesBelongToTheMachineAndScoresToTheRun) {
  EXPECT_THAT(DifferentBits(Scored(0.1, 20), Scored(0.1, 30)), IsEmpty());
  EXPECT_THAT(DifferentBits(Scored(0.1, 20), Scored(std::nextafter(0.1, 1.0), 20)),
              ElementsAre(StartsWith("ate_rmse_m: ")));
}

TEST(BitsTest, OtherTrajectoriesAndScoresThatAreGoneAreNamed) {
  RunRecord other = Scored(0.1, 20);
  other.output_hash = "4567";
  other.scores.erase("ate_rmse_m");
  EXPECT_THAT(DifferentBits(Scored(0.1, 20), other),
              ElementsAre("trajectories: 0123 and 4567", "ate_rmse_m: missing in the second"));
}

TEST(BitsTest, WhatOneLacksIsToldWhicheverIsNamedFirst) {
  const RunRecord fewer = Scored(0.1, 20);
  RunRecord more = fewer;
  more.scores["coverage"].value = 1;
  more.scores["ms_render_mean"].value = 3;
  EXPECT_THAT(DifferentBits(more, fewer), ElementsAre("coverage: missing in the second"));
  EXPECT_THAT(DifferentBits(fewer, more), ElementsAre("coverage: missing in the first"));
}

TEST(BitsTest, ARunOnItsOwnHasNoPenaltyToCompare) {
  RunRecord beside_twin = Scored(0.1, 20);
  beside_twin.scores["dynamic_penalty"].value = 5;
  EXPECT_THAT(DifferentBits(beside_twin, Scored(0.1, 20)), IsEmpty());
  EXPECT_THAT(DifferentBits(Scored(0.1, 20), beside_twin), IsEmpty());
}

}  // namespace
}  // namespace aisle
