#include "slam/place/adjust_loop.h"

#include <gtest/gtest.h>

#include "tests/slam/track/point_world.h"

namespace aisle::slam {
namespace {

/// A map of the world's origin, and a keyframe in the midst of its points that has passed half of
/// them; it knows no landmark.
class AdjustViewTest : public testing::Test {
 protected:
  void SetUp() override {
    TrackMemory memory;
    BeginAtOrigin(world, &map, &memory);
    Keyframe keyframe;
    keyframe.id = passed = map.NextKeyframeId();
    keyframe.parent = memory.reference;
    keyframe.T_world_rig = At(0, 8);
    keyframe.frame = world.See(keyframe.T_world_rig, 1);
    keyframe.landmarks.resize(static_cast<std::size_t>(keyframe.frame->size()));
    MapEdit edit;
    edit.new_keyframes = {keyframe};
    map.Apply(edit);
    for (const LandmarkId id : memory.landmarks) {
      matches.push_back({id, static_cast<int>(matches.size()), 0});
    }
  }

  /// The origin seen again, by a view that is taken to stand a little off.
  std::optional<AdjustedView> SeeAgain() const {
    const auto frame = world.See(At(0, 0), 2);
    return AdjustView(map, *frame, matches, std::vector<bool>(matches.size(), true),
                      At(0.02, 0.01, 0.2).inverse(), {});
  }

  PointWorld world;
  Map map;
  KeyframeId passed;
  std::vector<Match> matches;
};

TEST_F(AdjustViewTest, FindsWhereTheViewIs) {
  const auto view = SeeAgain();
  ASSERT_TRUE(view);
  EXPECT_LT(Difference(At(0, 0), view->T_rig_world).norm(), 1e-4);
  EXPECT_EQ(view->inliers, std::ssize(matches));
}

TEST_F(AdjustViewTest, OneOldObservationFromBehindVetoesNoLoop) {
  const auto behind = std::ranges::find_if(matches, [&](const Match& match) {
    return (map.At(passed).T_world_rig.inverse() * map.At(match.landmark).position).z() < -1;
  });
  ASSERT_NE(behind, matches.end());
  MapEdit edit;
  edit.links = {{behind->landmark, {passed, 0}}};
  map.Apply(edit);
  ASSERT_EQ(map.At(behind->landmark).observations.size(), 2u);
  const auto view = SeeAgain();
  ASSERT_TRUE(view);
  EXPECT_LT(Difference(At(0, 0), view->T_rig_world).norm(), 1e-4);
  EXPECT_EQ(view->inliers, std::ssize(matches));
}

}  // namespace
}  // namespace aisle::slam
