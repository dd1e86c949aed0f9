#include "slam/mapping/orbslam2_mapping.h"

#include <gtest/gtest.h>

namespace aisle::slam {
namespace {

/// Keyframes at the origin that see what they are told to: feature i of each is landmark i's.
class MadeUpMap {
 public:
  KeyframeId AddKeyframe(int features, double disparity = 20, int level = 0) {
    auto frame = std::make_shared<Frame>();
    for (int i = 0; i < features; ++i) {
      Keypoint keypoint;
      keypoint.pixel = {static_cast<float>(10 + i), 10};
      keypoint.level = level;
      frame->features.keypoints.push_back(keypoint);
      frame->features.descriptors.emplace_back();
      frame->measurements.push_back({{10.0 + i, 10, disparity}, 1, 1});
    }
    Keyframe keyframe;
    keyframe.id = map.NextKeyframeId();
    keyframe.frame = frame;
    if (keyframe.id.value > 0) keyframe.parent = {keyframe.id.value - 1};
    keyframe.landmarks.resize(static_cast<std::size_t>(features));
    MapEdit edit;
    edit.new_keyframes = {keyframe};
    map.Apply(edit);
    return keyframe.id;
  }

  LandmarkId AddLandmark(int feature, const std::vector<KeyframeId>& observers) {
    Landmark landmark;
    landmark.position = {0, 0, 5};
    landmark.created_by = observers.front();
    landmark.predicted = landmark.found = 1;
    for (const KeyframeId id : observers) landmark.observations.push_back({id, feature});
    MapEdit edit;
    edit.new_landmarks = {landmark};
    map.Apply(edit);
    return map.At(observers.front()).landmarks[static_cast<std::size_t>(feature)];
  }

  Map map;
};

TEST(OrbSlam2Culling, ANewLandmarkNeedsASecondStereoKeyframeInTime) {
  MadeUpMap made;
  const KeyframeId first = made.AddKeyframe(2), second = made.AddKeyframe(2);
  const LandmarkId lonely = made.AddLandmark(0, {first});
  made.AddLandmark(1, {first, second});
  EXPECT_TRUE(OrbSlam2CullLandmarks(made.map, second, {}).removed_landmarks.empty());
  const KeyframeId third = made.AddKeyframe(0);
  EXPECT_EQ(OrbSlam2CullLandmarks(made.map, third, {}).removed_landmarks,
            std::vector<LandmarkId>{lonely});
  made.AddKeyframe(0);
  const KeyframeId fifth = made.AddKeyframe(0);  // beyond probation
  EXPECT_TRUE(OrbSlam2CullLandmarks(made.map, fifth, {}).removed_landmarks.empty());
}

TEST(OrbSlam2Culling, ANewLandmarkMustBeFoundInAQuarterOfItsFrames) {
  MadeUpMap made;
  const KeyframeId first = made.AddKeyframe(2), second = made.AddKeyframe(2);
  const LandmarkId rare = made.AddLandmark(0, {first, second});
  const LandmarkId usual = made.AddLandmark(1, {first, second});
  MapEdit edit;
  edit.counts = {{rare, 4, 0}, {usual, 3, 0}};  // 1 of 5 and 1 of 4
  made.map.Apply(edit);
  EXPECT_EQ(OrbSlam2CullLandmarks(made.map, second, {}).removed_landmarks,
            std::vector<LandmarkId>{rare});
}

TEST(OrbSlam2Culling, ALandmarkWithOneStereoObservationLeftGoes) {
  MadeUpMap made;
  const KeyframeId first = made.AddKeyframe(2), second = made.AddKeyframe(2);
  const LandmarkId one = made.AddLandmark(0, {first}), two = made.AddLandmark(1, {first, second});
  EXPECT_EQ(OrbSlam2DropUnsupported(made.map, {one, two}, {}).removed_landmarks,
            std::vector<LandmarkId>{one});
}

/// Five keyframes; of 20 landmarks the second one sees, `elsewhere` are seen by the three others.
/// Whether it is culled.
bool GoesWith(int elsewhere, double disparity = 20, int level_of_others = 0) {
  MadeUpMap made;
  made.AddKeyframe(0);
  const KeyframeId asked = made.AddKeyframe(20, disparity);
  std::vector<KeyframeId> all = {asked};
  for (int k = 0; k < 3; ++k) all.push_back(made.AddKeyframe(20, disparity, level_of_others));
  for (int i = 0; i < 20; ++i) {
    made.AddLandmark(i, i < elsewhere ? all : std::vector{asked, all.back()});
  }
  const MapEdit edit = OrbSlam2CullKeyframes(made.map, all.back(), {}, {});
  return std::ranges::count(edit.removed_keyframes, asked) > 0;
}

TEST(OrbSlam2Culling, AKeyframeGoesWhoseClosePointsThreeOthersSee) {
  EXPECT_TRUE(GoesWith(19));
  EXPECT_FALSE(GoesWith(18));        // nine tenths, not more
  EXPECT_FALSE(GoesWith(20, 5));     // far points do not count
  EXPECT_TRUE(GoesWith(20, 20, 1));  // as sharply, give or take a level
  EXPECT_FALSE(GoesWith(20, 20, 2));
}

/// Where two views of a point put it, feature 0 here and there; disparity 0: not measured.
std::optional<Eigen::Vector3d> Placed(const Eigen::Vector3d& point, const Eigen::Vector3d& moved,
                                      double wrong_disparity, bool depth_here, bool depth_there) {
  const StereoCamera camera;
  const auto keyframe = [&](const Eigen::Vector3d& in_rig, bool depth) {
    auto frame = std::make_shared<Frame>();
    Eigen::Vector3d uvd = Project(camera, in_rig);
    uvd.z() *= wrong_disparity;
    frame->measurements.push_back({uvd, 1, depth ? 1.0 : 0.0});
    Keyframe one;
    one.frame = frame;
    return one;
  };
  const Keyframe here = keyframe(point, depth_here), there = keyframe(point - moved, depth_there);
  Eigen::Isometry3d T_there_here = Eigen::Isometry3d::Identity();
  T_there_here.translation() = -moved;
  return OrbSlam2Place(0.02)({here, there, camera, T_there_here}, 0, 0);
}

TEST(OrbSlam2Points, WiderRaysThanTheBaselinePlaceAPointElseDisparityDoes) {
  const Eigen::Vector3d point(0.5, 0.2, 8);
  // Disparities that say 5 % nearer tell which of the two has spoken.
  const auto wide = Placed(point, {0.3, 0, 0}, 1.05, true, true);
  ASSERT_TRUE(wide);
  EXPECT_LT((*wide - point).norm(), 1e-9);
  const auto narrow = Placed(point, {0.05, 0, 0.2}, 1.05, true, false);
  ASSERT_TRUE(narrow);
  EXPECT_NEAR(narrow->z(), 8 / 1.05, 1e-9);
  const auto by_other = Placed(point, {0.05, 0, 0.2}, 1.05, false, true);
  ASSERT_TRUE(by_other);
  EXPECT_NEAR(by_other->z(), 0.2 + 7.8 / 1.05, 1e-9);
}

TEST(OrbSlam2Points, WithoutDepthRaysNeedSomeParallax) {
  const Eigen::Vector3d point(0, 0, 8);
  EXPECT_TRUE(Placed(point, {0.2, 0, 0}, 1, false, false));
  EXPECT_FALSE(Placed(point, {0.1, 0, 0}, 1, false, false));
}

TEST(OrbSlam2Policy, AllIsSeenAfterTheMappersFramesAndOnlyTheAdjustmentIsGivenUp) {
  for (const int frames : {1, 2, 5}) {
    int all = 0;
    const MappingPolicy policy = OrbSlam2Mapping({}, frames);
    for (const MappingStep& step : policy) {
      all += step.frames;
      EXPECT_EQ(static_cast<bool>(step.given_up), &step == &policy.back());
    }
    EXPECT_EQ(all, frames);
  }
}

}  // namespace
}  // namespace aisle::slam
