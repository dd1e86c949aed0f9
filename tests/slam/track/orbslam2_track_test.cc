#include "slam/track/orbslam2_track.h"

#include <gtest/gtest.h>

#include "slam/track/orbslam2_keyframe.h"
#include "slam/track/orbslam2_local_map.h"
#include "tests/slam/track/point_world.h"

namespace aisle::slam {
namespace {

/// The first `count` features of a frame.
std::shared_ptr<const Frame> Few(const Frame& frame, int count) {
  auto few = std::make_shared<Frame>(frame);
  const auto size = static_cast<std::size_t>(count);
  few->features.keypoints.resize(size);
  few->features.descriptors.resize(size);
  few->measurements.resize(size);
  few->grid = FeatureGrid(few->features.keypoints, {752, 480});
  return few;
}

/// One keyframe at the origin, which is the last frame too; the rig is settled and stands still.
class OrbSlam2TrackTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto frame = world.See(At(0, 0), 0);
    OrbSlam2Options all;
    all.first_features = 50;
    map.Apply(*OrbSlam2FirstKeyframe(frame, {}, all));
    memory.frame = frame;
    for (int i = 0; i < frame->size(); ++i) {
      const auto feature = static_cast<std::size_t>(i);
      memory.matches.push_back({map.At(reference).landmarks[feature], i, 0});
    }
    memory.T_now_before = Eigen::Isometry3d::Identity();
    memory.frames_since_found = 100;
    memory.seconds_since_found = 5;
  }

  std::optional<FramePose> Track(const Frame& frame) const {
    return OrbSlam2Track({map, frame, {}, 8, options}, At(0, 0), reference, memory);
  }

  static void ExpectAt(const Eigen::Isometry3d& truth, const std::optional<FramePose>& found) {
    ASSERT_TRUE(found);
    EXPECT_LT(Difference(truth.inverse(), found->pose.T_rig_world).norm(), 1e-4);
  }

  PointWorld world;
  Map map;
  const KeyframeId reference{0};
  OrbSlam2Memory memory;
  OrbSlam2Options options;
};

TEST_F(OrbSlam2TrackTest, FollowsItsMotion) {
  const Eigen::Isometry3d truth = At(0.03, 0.2, 2);
  memory.T_now_before = truth.inverse();
  ExpectAt(truth, Track(*world.See(truth, 50'000'000)));
}

TEST_F(OrbSlam2TrackTest, FallsBackOnTheReferenceKeyframe) {
  const Eigen::Isometry3d truth = At(0.3, 0.2, 3);
  memory.T_now_before = At(0, 0, -40).inverse();
  ExpectAt(truth, Track(*world.See(truth, 50'000'000)));
  memory.T_now_before.reset();
  ExpectAt(truth, Track(*world.See(truth, 50'000'000)));
}

TEST_F(OrbSlam2TrackTest, ThirtyInliersAreEnoughWhateverElseShouldBeSeen) {
  const auto all = world.See(At(0.01, 0.02), 50'000'000);
  EXPECT_TRUE(Track(*Few(*all, 30)));
  EXPECT_FALSE(Track(*Few(*all, 29)));
}

TEST_F(OrbSlam2TrackTest, ForASecondAfterBeingFoundFiftyAreAskedFor) {
  const auto all = world.See(At(0.01, 0.02), 50'000'000);
  memory.seconds_since_found = 0.95;
  EXPECT_TRUE(Track(*Few(*all, 50)));
  EXPECT_FALSE(Track(*Few(*all, 49)));
}

TEST_F(OrbSlam2TrackTest, GoesWithTheMajorityAndNeverAsksHowFar) {
  // Three in four points walk on with the rig, which drives 0.1 m: to them it stands still.
  world.Move(0, 450, {0, 0, 0.1});
  const auto found = Track(*world.See(At(0, 0.1), 50'000'000));
  ASSERT_TRUE(found);
  EXPECT_LT(found->pose.T_rig_world.translation().norm(), 0.02);
}

TEST_F(OrbSlam2TrackTest, IsLostWhereNothingIsKnown) {
  EXPECT_FALSE(Track(*world.See(At(0, 0, 180), 50'000'000)));
}

TEST_F(OrbSlam2TrackTest, ALostRigNeedsFiftyPointsOfAKeyframe) {
  const Eigen::Isometry3d truth = At(0.4, 0.5, -6);
  const auto all = world.See(truth, 50'000'000);
  ExpectAt(truth, OrbSlam2Relocalise({map, *all, {}, 8, options}, {reference}));
  EXPECT_FALSE(OrbSlam2Relocalise({map, *Few(*all, 45), {}, 8, options}, {reference}));
  EXPECT_FALSE(OrbSlam2Relocalise({map, *all, {}, 8, options}, {}));
}

/// Keyframes in a chain: k sees landmarks 20 k to 20 k + 39.
Map Chain(int keyframes) {
  Map map;
  const auto frame = Few(*PointWorld().See(At(0, 0), 0), 40);
  for (int k = 0; k < keyframes; ++k) {
    MapEdit edit;
    Keyframe keyframe;
    keyframe.id = {k};
    keyframe.frame = frame;
    if (k > 0) keyframe.parent = {k - 1};
    keyframe.landmarks.resize(40);
    for (std::size_t i = 0; k > 0 && i < 20; ++i) {
      keyframe.landmarks[i] = map.At(KeyframeId{k - 1}).landmarks[i + 20];
    }
    for (int i = k > 0 ? 20 : 0; i < 40; ++i) {
      Landmark landmark;
      landmark.position = {0, 0, 5};
      landmark.observations = {{{k}, i}};
      landmark.created_by = {k};
      edit.new_landmarks.push_back(landmark);
    }
    edit.new_keyframes = {keyframe};
    map.Apply(edit);
  }
  return map;
}

TEST(OrbSlam2LocalMapTest, TakesTheObserversAndWhatTheyBringUntilAParentIsNew) {
  const Map map = Chain(12);
  // Landmarks that 5 and 6 see: 5 brings 4 as its neighbour, its child 6 is there, its parent too;
  // 6 brings 7 as its neighbour.
  std::vector<LandmarkId> seen(map.At(KeyframeId{6}).landmarks.begin(),
                               map.At(KeyframeId{6}).landmarks.begin() + 20);
  const LocalMap local = OrbSlam2LocalMap(map, seen, {});
  EXPECT_EQ(local.keyframes, (std::vector<KeyframeId>{{5}, {6}, {4}, {7}}));
  EXPECT_EQ(local.landmarks.size(), 100u);  // 20 * 4 to 20 * 7 + 39
  seen.push_back(map.At(KeyframeId{6}).landmarks.back());
  EXPECT_EQ(OrbSlam2LocalMap(map, seen, {}).reference, KeyframeId{6});
}

TEST(OrbSlam2LocalMapTest, DoesNotGrowBeyondItsBound) {
  const Map map = Chain(12);
  OrbSlam2Options few;
  few.local_keyframes = 1;
  const std::vector<LandmarkId> seen(map.At(KeyframeId{6}).landmarks.begin(),
                                     map.At(KeyframeId{6}).landmarks.begin() + 20);
  EXPECT_EQ(OrbSlam2LocalMap(map, seen, few).keyframes.size(), 2u);
}

}  // namespace
}  // namespace aisle::slam
