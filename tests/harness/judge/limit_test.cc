#include "harness/judge/limit.h"

#include <gtest/gtest.h>

namespace aisle {
namespace {

const Limit kTight{
    .score = "ate_rmse_m", .scene = "", .twin = "live", .system = "oracle", .min = {}, .max = 0.02};

TEST(LimitTest, AScoreThatIsAbsentFails) {
  RunRecord run;
  run.spec = {
      .scene = "s", .scene_file = "", .twin = "live", .system = BuiltIn("oracle"), .seed = 1};
  run.scores["ate_rmse_m"].absent = "no poses";
  const auto verdicts = Judge({run}, {kTight});
  ASSERT_EQ(verdicts.size(), 1u);
  EXPECT_FALSE(verdicts[0].passed);
  EXPECT_EQ(verdicts[0].why, "seed 1 has no value: no poses");
}

TEST(LimitTest, TheMedianOverSeedsIsHeldAgainstTheBound) {
  std::vector<RunRecord> runs(3);
  const double values[] = {0.01, 0.5, 0.015};
  for (std::size_t i = 0; i < 3; ++i) {
    runs[i].spec = {
        .scene = "s", .scene_file = "", .twin = "live", .system = BuiltIn("oracle"), .seed = i};
    runs[i].scores["ate_rmse_m"] = {
        .value = values[i], .unit = "m", .alignment = "se3", .n = 9, .absent = ""};
  }
  const auto verdicts = Judge(runs, {kTight});
  ASSERT_EQ(verdicts.size(), 1u);
  EXPECT_TRUE(verdicts[0].passed);
  EXPECT_DOUBLE_EQ(*verdicts[0].value, 0.015);
}

TEST(LimitTest, ALimitThatMatchesNothingFails) {
  const auto verdicts = Judge({}, {kTight});
  ASSERT_EQ(verdicts.size(), 1u);
  EXPECT_FALSE(verdicts[0].passed);
}

TEST(LimitTest, ACrashFailsWithoutAnyLimit) {
  RunRecord run;
  run.spec.system = BuiltIn("oracle");
  run.status = RunStatus::kCrashed;
  run.status_why = "signal 11";
  const auto verdicts = Judge({run}, {});
  ASSERT_EQ(verdicts.size(), 1u);
  EXPECT_EQ(verdicts[0].why, "crashed: signal 11");
}

}  // namespace
}  // namespace aisle
