#include "harness/campaign/worst_frames.h"

#include <gtest/gtest.h>

namespace aisle {
namespace {

FrameRow Row(std::int64_t id, double time_s, std::optional<double> error_m) {
  FrameRow row;
  row.id = id;
  row.stamp_ns = static_cast<std::int64_t>(1e9 * time_s);
  row.live_error_m = error_m;
  return row;
}

TEST(WorstFrames, AreTheLargestThatLieApart) {
  const std::vector<FrameRow> rows = {Row(0, 0, 0.1),   Row(1, 0.5, 0.9), Row(2, 1.0, 0.8),
                                      Row(3, 1.6, 0.3), Row(4, 5, 0.3),   Row(5, 9, std::nullopt)};
  const auto worst = FindWorstFrames(rows, 3, 1);
  ASSERT_EQ(worst.size(), 3u);
  EXPECT_EQ(worst[0].id, 1);
  EXPECT_EQ(worst[1].id, 3);  // frame 2 is half a second from the worst
  EXPECT_EQ(worst[2].id, 4);
  EXPECT_DOUBLE_EQ(worst[0].error_m, 0.9);
  EXPECT_TRUE(FindWorstFrames({}, 3, 1).empty());
}

}  // namespace
}  // namespace aisle
