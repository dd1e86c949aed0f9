#include "slam/map/match_by_projection.h"

#include <gtest/gtest.h>

namespace aisle::slam {
namespace {

/// A descriptor that differs from the empty one in so many bits.
Descriptor Bits(int count) {
  Descriptor descriptor{};
  for (int i = 0; i < count; ++i) {
    descriptor[static_cast<std::size_t>(i / 64)] |= std::uint64_t{1} << (i % 64);
  }
  return descriptor;
}

/// How many matches a landmark has among features around it, of those distances in bits, in the
/// order in which the frame has them.
std::size_t Matches(const std::vector<int>& bits, const std::vector<int>& levels = {}) {
  const StereoCamera camera;
  Frame frame;
  for (std::size_t i = 0; i < bits.size(); ++i) {
    Keypoint keypoint;
    keypoint.pixel = {99.0F + static_cast<float>(i), 100.0F};
    if (!levels.empty()) keypoint.level = levels[i];
    frame.features.keypoints.push_back(keypoint);
    frame.features.descriptors.push_back(Bits(bits[i]));
    frame.measurements.push_back({{keypoint.pixel.x, keypoint.pixel.y, 0}, 1, 0});
  }
  frame.grid = FeatureGrid(frame.features.keypoints, {camera.width, camera.height});
  Landmark landmark;
  landmark.id = {0, 0};
  const Expected expected{&landmark, {100, 100, 0}, 0};
  const MatchOptions options{4, 100, 0.8};
  return MatchByProjection(frame, std::span(&expected, 1), options).size();
}

TEST(MatchByProjection, ARivalIsOneInWhicheverOrderTheyAreMet) {
  for (const auto& [best, rival] : {std::pair(95, 102), std::pair(95, 98), std::pair(40, 49)}) {
    EXPECT_EQ(Matches({best, rival}), 0u) << best << " and " << rival;
    EXPECT_EQ(Matches({rival, best}), 0u) << rival << " and " << best;
    EXPECT_EQ(Matches({200, rival, best}), 0u) << "200, " << rival << " and " << best;
  }
  EXPECT_EQ(Matches({95, 120}), 1u);
  EXPECT_EQ(Matches({120, 95}), 1u);
  EXPECT_EQ(Matches({101}), 0u);
}

TEST(MatchByProjection, TheSameCornerOnAnotherLevelIsNoRival) {
  EXPECT_EQ(Matches({40, 45}, {0, 1}), 1u);
  EXPECT_EQ(Matches({45, 40}, {1, 0}), 1u);
}

}  // namespace
}  // namespace aisle::slam
