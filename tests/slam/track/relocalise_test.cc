#include "slam/track/relocalise.h"

#include <gtest/gtest.h>

#include "tests/slam/track/point_world.h"

namespace aisle::slam {
namespace {

/// Two keyframes: the first has seen a third of what the second has, and where it is has been
/// mistaken by 2 m, as of a bay that looks like another.
class RelocaliseTest : public testing::Test {
 protected:
  void SetUp() override {
    BeginAtOrigin(world, &map, &memory);
    const KeyframeId right = memory.reference;
    MapEdit edit;
    Keyframe alike;
    alike.id = map.NextKeyframeId();
    alike.frame = Third(*map.At(right).frame);
    alike.T_world_rig = At(2, 0);
    alike.landmarks.resize(static_cast<std::size_t>(alike.frame->size()));
    edit.new_landmarks = CreateLandmarks(alike, {}, {});
    edit.new_keyframes = {alike};
    map.Apply(edit);
    memory.reference = alike.id;  // asked first
  }

  static std::shared_ptr<const Frame> Third(const Frame& whole) {
    auto part = std::make_shared<Frame>();
    for (std::size_t i = 0; i < whole.measurements.size(); i += 3) {
      part->features.keypoints.push_back(whole.features.keypoints[i]);
      part->features.descriptors.push_back(whole.features.descriptors[i]);
      part->measurements.push_back(whole.measurements[i]);
    }
    const StereoCamera camera;
    part->grid = FeatureGrid(part->features.keypoints, {camera.width, camera.height});
    return part;
  }

  std::optional<FramePose> Locate(const std::function<bool(const FramePose&)>& is_possible) {
    const auto frame = world.See(At(0.1, 0.2), 1'000'000'000);
    return LocateByLooks({map, *frame, {}, 8, {}}, memory, {nullptr, index}, 0, is_possible);
  }

  PointWorld world;
  PlaceIndex index;
  Map map;
  TrackMemory memory;
};

TEST_F(RelocaliseTest, ThePlaceThatExplainsMoreIsBelievedWhicheverIsAskedFirst) {
  const auto frame = world.See(At(0.1, 0.2), 1'000'000'000);
  const auto first = LocateByKeyframe({map, *frame, {}, 8, {}}, memory.reference);
  ASSERT_TRUE(first);
  ASSERT_GT(Difference(At(0.1, 0.2).inverse(), first->pose.T_rig_world).norm(), 1);

  const auto found = Locate([](const FramePose&) { return true; });
  ASSERT_TRUE(found);
  EXPECT_LT(Difference(At(0.1, 0.2).inverse(), found->pose.T_rig_world).norm(), 1e-3);
}

TEST_F(RelocaliseTest, WhatIsNotPossibleIsNotBelievedHoweverMuchItExplains) {
  const auto found = Locate(
      [](const FramePose& pose) { return pose.pose.T_rig_world.inverse().translation().x() > 1; });
  ASSERT_TRUE(found);
  EXPECT_LT(Difference(At(2.1, 0.2).inverse(), found->pose.T_rig_world).norm(), 1e-3);
  EXPECT_FALSE(Locate([](const FramePose&) { return false; }));
}

}  // namespace
}  // namespace aisle::slam
