#include "harness/bench/foreign.h"

#include <gtest/gtest.h>

namespace aisle {
namespace {

const cv::Mat3f kGrey(32, 64, cv::Vec3f(0.2f, 0.4f, 0.6f));  // blue, green, red

TEST(CompareChannelsTest, APictureKeepsTheBoundsOfItself) {
  for (const ChannelComparison& channel : CompareChannels(kGrey, kGrey)) {
    EXPECT_DOUBLE_EQ(channel.ratio, 1);
    EXPECT_DOUBLE_EQ(channel.share, 1);
    EXPECT_TRUE(Keeps(channel));
  }
}

TEST(CompareChannelsTest, ChannelsAreNamedAndHeldOneByOne) {
  cv::Mat3f redder = kGrey.clone();
  for (cv::Vec3f& pixel : redder) pixel[2] *= 1.02f;
  const auto channels = CompareChannels(redder, kGrey);
  EXPECT_STREQ(channels[0].name, "red");
  EXPECT_NEAR(channels[0].ratio, 1.02, 1e-6);
  EXPECT_DOUBLE_EQ(channels[0].share, 1);  // every block is within 3 %
  EXPECT_FALSE(Keeps(channels[0]));        // the mean is not within 0.5 %
  EXPECT_TRUE(Keeps(channels[1]));
  EXPECT_TRUE(Keeps(channels[2]));
}

TEST(CompareChannelsTest, BlocksThatCancelInTheMeanAreCounted) {
  cv::Mat3f patched = kGrey.clone();  // two of 32 blocks, one too bright and one as much too dark
  patched(cv::Rect(0, 0, 8, 8)) *= 1.1;
  patched(cv::Rect(8, 0, 8, 8)) *= 0.9;
  for (const ChannelComparison& channel : CompareChannels(patched, kGrey)) {
    EXPECT_NEAR(channel.ratio, 1, 1e-6);
    EXPECT_DOUBLE_EQ(channel.share, 30.0 / 32);
    EXPECT_FALSE(Keeps(channel));
  }
}

}  // namespace
}  // namespace aisle
