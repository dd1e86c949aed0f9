#include "harness/score/front_end.h"

#include <gtest/gtest.h>

#include "harness/score/scorecard.h"

namespace aisle {
namespace {

TEST(FrontEnd, IsWhatTheCallerWaitsFor) {
  const auto front_end = FrontEndOf({{"dynamic", 30},
                                     {"extract", 7},
                                     {"stereo", 3},
                                     {"track", 2},
                                     {"wait_for_mapping", 1},
                                     {"mapping", 50}});  // beside the caller
  ASSERT_TRUE(front_end);
  EXPECT_DOUBLE_EQ(front_end->dynamic, 30);
  EXPECT_DOUBLE_EQ(front_end->tracking, 13);
  EXPECT_DOUBLE_EQ(front_end->total(), 43);
}

TEST(FrontEnd, OfASystemThatNamesOtherStagesNothingIsKnown) {
  EXPECT_FALSE(FrontEndOf({}));
  EXPECT_FALSE(FrontEndOf({{"mapping", 50}, {"network", 200}}));
}

TEST(FrontEnd, IsAScoreOfTheRun) {
  RunResult run;
  run.estimates.resize(2);
  run.estimates[0].stage_ms = {{"dynamic", 30}, {"track", 10}};
  run.estimates[1].stage_ms = {{"dynamic", 20}, {"track", 12}};
  const Scorecard scores = ScoreRun(run).scores;
  EXPECT_DOUBLE_EQ(*scores.at("ms_front_end_mean").value, 36);
  EXPECT_DOUBLE_EQ(*scores.at("ms_tracking_mean").value, 11);
  EXPECT_DOUBLE_EQ(*scores.at("ms_dynamic_mean").value, 25);
}

}  // namespace
}  // namespace aisle
