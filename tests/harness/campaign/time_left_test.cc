#include "harness/campaign/time_left.h"

#include <gtest/gtest.h>

#include "harness/record/record.h"
#include "tests/harness/campaign/job_of.h"

namespace aisle {
namespace {

using test::JobOf;

std::vector<JobProgress> At(const Job& job, int done, int total) {
  return {{&job, {done, total, ""}}};
}

TEST(TimeLeft, CountsWorkAndNotRuns) {
  const Job long_one = JobOf("long", "plain"), short_one = JobOf("short", "plain");
  TimeLeft left({long_one, short_one}, {{RunId(long_one.spec), {.drive_s = 90}},
                                        {RunId(short_one.spec), {.drive_s = 10}}});
  EXPECT_FALSE(left.Seconds(5, {}));
  // A third of the long one is 30 of 100 seconds; this machine took 60 for them.
  EXPECT_NEAR(left.Seconds(60, At(long_one, 300, 900)).value(), 140, 1e-9);
  left.Ended(long_one);
  EXPECT_NEAR(left.Seconds(180, {}).value(), 20, 1e-9);
  left.Ended(short_one);
  EXPECT_EQ(left.Seconds(200, {}).value(), 0);
}

TEST(TimeLeft, RenderingIsTheFirstRunsWork) {
  const Job first = JobOf("scene", "robust"), second = JobOf("scene", "plain");
  const ExpectedTimes times{{RunId(first.spec), {10, 80}}, {RunId(second.spec), {10, 80}}};
  TimeLeft left({first, second}, times);
  left.Ended(first);
  EXPECT_NEAR(left.Seconds(90, {}).value(), 10, 1e-9);
}

TEST(TimeLeft, WhatNobodyExpectedCountsAsTheMean) {
  const Job a = JobOf("a", "plain"), b = JobOf("b", "plain"), c = JobOf("c", "plain");
  TimeLeft left({c, a, b}, {{RunId(a.spec), {10}}, {RunId(b.spec), {30}}});
  left.Ended(c);
  EXPECT_NEAR(left.Seconds(20, {}).value(), 40, 1e-9);
  TimeLeft none({a, b}, {});
  none.Ended(a);
  EXPECT_NEAR(none.Seconds(7, {}).value(), 7, 1e-9);
}

TEST(TimeLeft, SaysNothingBeforeThereIsSomethingToTellItBy) {
  const Job a = JobOf("a", "plain"), stranger = JobOf("stranger", "plain");
  TimeLeft left({a}, {{RunId(a.spec), {1000}}});
  EXPECT_FALSE(left.Seconds(1, At(a, 1, 1000)));
  EXPECT_TRUE(left.Seconds(5, At(a, 5, 1000)));
  EXPECT_FALSE(left.Seconds(5, {{&a, {0, 0, "light"}}}));
  EXPECT_FALSE(left.Seconds(5, At(stranger, 5, 10)));
  EXPECT_FALSE(TimeLeft({}, {}).Seconds(5, {}));
}

}  // namespace
}  // namespace aisle
