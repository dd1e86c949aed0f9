#include "slam/track/continuity.h"

#include <gtest/gtest.h>

#include <random>

namespace aisle::slam {
namespace {

Frame FrameOf(std::uint64_t seed, int features) {
  std::mt19937_64 random(seed);
  Frame frame;
  for (int i = 0; i < features; ++i) {
    frame.features.keypoints.emplace_back();
    frame.features.descriptors.push_back({random(), random(), random(), random()});
  }
  return frame;
}

TEST(IsCut, IsToldFromAViewThatMoves) {
  const Frame before = FrameOf(1, 1200);
  Frame now = FrameOf(2, 1200);
  EXPECT_TRUE(IsCut(before, now, 1200));
  for (std::size_t i = 0; i < 30; ++i) {  // a tenth of their bits have changed
    now.features.descriptors[i] = before.features.descriptors[100 + i];
    now.features.descriptors[i][0] ^= 0x11111111'11111111;
    now.features.descriptors[i][1] ^= 0xff;
  }
  EXPECT_FALSE(IsCut(before, now, 1200));
}

/// A wall of one tile: everything looks like everything.
TEST(IsCut, LikenessThatIsNobodysOwnTellsNothing) {
  Frame before = FrameOf(1, 800), now = FrameOf(2, 800);
  for (Descriptor& one : before.features.descriptors) one = {};
  for (Descriptor& one : now.features.descriptors) one = {1, 0, 0, 0};
  EXPECT_TRUE(IsCut(before, now, 1200));
}

TEST(IsCut, IsNotSaidOfWhatShowsBesideAMover) {
  EXPECT_FALSE(IsCut(FrameOf(1, 1200), FrameOf(2, 500), 1200));
  EXPECT_FALSE(IsCut(FrameOf(1, 500), FrameOf(2, 1200), 1200));
}

TEST(IsCut, IsSaidOfFramesThatAreFullWhateverTheirBudget) {
  EXPECT_TRUE(IsCut(FrameOf(1, 400), FrameOf(2, 400), 500));
  EXPECT_FALSE(IsCut(FrameOf(1, 400), FrameOf(2, 200), 500));
}

TEST(ShowsSomething, IsNotSaidOfTheDark) {
  EXPECT_FALSE(ShowsSomething(Frame()));
  EXPECT_FALSE(ShowsSomething(FrameOf(1, 5)));
  EXPECT_TRUE(ShowsSomething(FrameOf(1, 300)));
}

}  // namespace
}  // namespace aisle::slam
