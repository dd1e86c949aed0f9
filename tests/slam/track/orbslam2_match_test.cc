#include "slam/track/orbslam2_match.h"

#include <gtest/gtest.h>

namespace aisle::slam {
namespace {

/// A description that is `bits` off from an empty one.
Descriptor Off(int bits) {
  Descriptor descriptor{};
  for (int i = 0; i < bits; ++i) descriptor[0] |= std::uint64_t{1} << i;
  return descriptor;
}

struct Feature {
  Eigen::Vector3d uvd;
  int level = 0;
  int bits_off = 0;
};

Frame FrameOf(const std::vector<Feature>& features) {
  Frame frame;
  for (const Feature& feature : features) {
    Keypoint keypoint;
    keypoint.pixel = {static_cast<float>(feature.uvd.x()), static_cast<float>(feature.uvd.y())};
    keypoint.level = feature.level;
    frame.features.keypoints.push_back(keypoint);
    frame.features.descriptors.push_back(Off(feature.bits_off));
    frame.measurements.push_back({feature.uvd, 1, feature.uvd.z() > 0 ? 1.0 : 0.0});
  }
  frame.grid = FeatureGrid(frame.features.keypoints, {752, 480});
  return frame;
}

class OrbSlam2Match : public testing::Test {
 protected:
  std::vector<Match> Run(const std::vector<Feature>& features, const std::vector<Sought>& sought) {
    const Frame frame = FrameOf(features);
    std::vector<bool> taken(features.size(), false);
    return MatchInTurn(frame, sought, 50, 0.8, taken);
  }

  Landmark landmark;
  const Sought one{&landmark, {100, 100, 20}, 5, 0, 1};
};

TEST_F(OrbSlam2Match, TheFirstThatAsksHasTheFeature) {
  Landmark other;
  other.id = {1, 0};
  other.descriptor = Off(1);  // the feature itself
  Sought second = one;
  second.landmark = &other;
  const auto matches = Run({{{100, 100, 20}, 0, 1}}, {one, second});
  ASSERT_EQ(matches.size(), 1u);
  EXPECT_EQ(matches[0].landmark, landmark.id);
}

TEST_F(OrbSlam2Match, RivalsOfOneLevelMustBeTellable) {
  EXPECT_TRUE(Run({{{100, 100, 20}, 0, 9}, {{101, 100, 20}, 0, 10}}, {one}).empty());
  EXPECT_EQ(Run({{{100, 100, 20}, 0, 9}, {{101, 100, 20}, 1, 10}}, {one}).size(), 1u);
  EXPECT_EQ(Run({{{100, 100, 20}, 0, 8}, {{101, 100, 20}, 0, 10}}, {one}).size(), 1u);
}

TEST_F(OrbSlam2Match, WindowLevelsAndBitsBoundTheSearch) {
  EXPECT_EQ(Run({{{104, 96, 20}, 1, 50}}, {one}).size(), 1u);
  EXPECT_TRUE(Run({{{106, 100, 20}, 0, 0}}, {one}).empty());
  EXPECT_TRUE(Run({{{100, 100, 20}, 2, 0}}, {one}).empty());
  EXPECT_TRUE(Run({{{100, 100, 20}, 0, 51}}, {one}).empty());
}

TEST_F(OrbSlam2Match, TheRightImageIsAskedToo) {
  // 4 px aside in the left image, 4 px the other way in the right one, or along with it.
  EXPECT_TRUE(Run({{{104, 100, 30}, 0, 0}}, {one}).empty());
  EXPECT_EQ(Run({{{104, 100, 24}, 0, 0}}, {one}).size(), 1u);
  EXPECT_EQ(Run({{{104, 100, 0}, 0, 0}}, {one}).size(), 1u);  // has not seen it
}

TEST(OrbSlam2Turns, TheThreeFullestSectorsRemain) {
  std::vector<Match> matches;
  std::vector<float> turns;
  const auto add = [&](int count, float turn) {
    for (int i = 0; i < count; ++i) {
      matches.push_back({LandmarkId{static_cast<int>(matches.size()), 0}, 0, 0});
      turns.push_back(turn);
    }
  };
  add(20, -10), add(10, 355), add(8, 60), add(5, 120), add(4, 200);
  EXPECT_EQ(KeepCommonTurns(matches, turns).size(), 43u);  // -10 and 355 are one sector
}

TEST(OrbSlam2Turns, ASectorOfLessThanATenthGoes) {
  std::vector<Match> matches(111, Match{});
  std::vector<float> turns(100, 0);
  turns.insert(turns.end(), 10, 90), turns.push_back(180);
  EXPECT_EQ(KeepCommonTurns(matches, turns).size(), 110u);
  EXPECT_TRUE(KeepCommonTurns({}, {}).empty());
}

TEST(OrbSlam2Level, IsTheNextAbove) {
  Landmark landmark;
  landmark.reference_distance_m = 10;
  landmark.reference_level = 3;
  EXPECT_EQ(PredictLevelAbove(landmark, 10 / 1.05, 1.2, 8), 4);
  EXPECT_EQ(PredictLevelAbove(landmark, 10 * 1.05, 1.2, 8), 3);
  EXPECT_EQ(PredictLevelAbove(landmark, 1, 1.2, 8), 7);
  EXPECT_EQ(PredictLevelAbove(landmark, 100, 1.2, 8), 0);
}

}  // namespace
}  // namespace aisle::slam
