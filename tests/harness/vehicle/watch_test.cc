#include "harness/vehicle/watch.h"

#include <gtest/gtest.h>

namespace aisle {
namespace {

constexpr std::int64_t kFrame_ns = 50'000'000;

TEST(WatchTest, LostFramesMakeItCreepThenStopAndGoodOnesGoOn) {
  const WatchOptions options;
  WatchState state = AfterAnswer({}, true, 0, 0, options);
  EXPECT_EQ(state.trust, Trust::kGood);
  std::int64_t now = 0;
  for (int k = 0; k < options.lost_frames; ++k) {
    EXPECT_EQ(state.trust, Trust::kGood);
    now += kFrame_ns;
    state = AfterTime(AfterAnswer(state, false, 0, now, options), now, options);
  }
  EXPECT_EQ(state.trust, Trust::kCreep);
  while (now <= 1'100'000'000) state = AfterTime(state, now += kFrame_ns, options);
  EXPECT_EQ(state.trust, Trust::kStop);
  for (int k = 0; k < options.good_frames; ++k) {
    EXPECT_EQ(state.trust, Trust::kStop);
    state = AfterAnswer(state, true, 0.01, now += kFrame_ns, options);
  }
  EXPECT_EQ(state.trust, Trust::kGood);
}

TEST(WatchTest, APoseAfterCreepingIsEnough) {
  const WatchOptions options;
  WatchState state{.trust = Trust::kCreep};
  EXPECT_EQ(AfterAnswer(state, true, 0, 1, options).trust, Trust::kGood);
}

TEST(WatchTest, AJumpDoesNotEndAStop) {
  const WatchOptions options;
  WatchState state{.trust = Trust::kStop};
  for (int k = 0; k < 50; ++k) state = AfterAnswer(state, true, 0.5, k, options);
  EXPECT_EQ(state.trust, Trust::kStop);
}

TEST(WatchTest, AKnownLatencyIsNoReasonToCreep) {
  const WatchOptions options{.latency_s = 0.5};
  const WatchState state = AfterAnswer({}, true, 0, 0, options);
  EXPECT_EQ(AfterTime(state, 700'000'000, options).trust, Trust::kGood);
  EXPECT_EQ(AfterTime(state, 900'000'000, options).trust, Trust::kCreep);
}

TEST(WatchTest, BeforeTheFirstPoseItWaitsHoweverLong) {
  EXPECT_EQ(AfterTime({}, 60'000'000'000, {}).trust, Trust::kFirst);
}

}  // namespace
}  // namespace aisle
