#include "slam/track/track_frame.h"

#include <gtest/gtest.h>

#include <random>

#include "slam/map/create_landmarks.h"
#include "slam/track/keyframe_policy.h"

namespace aisle::slam {
namespace {

/// Points around a rig with descriptors of their own, seen without images.
class PointWorld {
 public:
  PointWorld() {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> x(-5, 5), y(-2, 2), z(3, 14);
    for (int i = 0; i < 600; ++i) {
      points_.emplace_back(x(random), y(random), z(random));
      descriptors_.push_back({random(), random(), random(), random()});
    }
  }

  std::shared_ptr<const Frame> See(const Eigen::Isometry3d& T_world_rig,
                                   std::int64_t stamp_ns) const {
    const StereoCamera camera;
    auto frame = std::make_shared<Frame>();
    frame->stamp_ns = stamp_ns;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Eigen::Vector3d in_rig = T_world_rig.inverse() * points_[i];
      if (in_rig.z() < 0.5) continue;
      const Eigen::Vector3d uvd = Project(camera, in_rig);
      if (!InImage(camera, uvd.x(), uvd.y())) continue;
      Keypoint keypoint;
      keypoint.pixel = {static_cast<float>(uvd.x()), static_cast<float>(uvd.y())};
      frame->features.keypoints.push_back(keypoint);
      frame->features.descriptors.push_back(descriptors_[i]);
      frame->measurements.push_back({uvd, 1, 0.3});
    }
    frame->grid = FeatureGrid(frame->features.keypoints, {camera.width, camera.height});
    return frame;
  }

 private:
  std::vector<Eigen::Vector3d> points_;
  std::vector<Descriptor> descriptors_;
};

Eigen::Isometry3d At(double x, double z, double yaw_deg = 0) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << x, 0, z;
  pose.linear() = Eigen::AngleAxisd(yaw_deg * M_PI / 180, Eigen::Vector3d::UnitY()).matrix();
  return pose;
}

class TrackFrameTest : public testing::Test {
 protected:
  void SetUp() override {
    Keyframe keyframe;
    keyframe.id = map.NextKeyframeId();
    keyframe.frame = world.See(At(0, 0), 0);
    keyframe.landmarks.resize(static_cast<std::size_t>(keyframe.frame->size()));
    MapEdit edit;
    edit.new_landmarks = CreateLandmarks(keyframe, {}, {});
    edit.new_keyframes = {keyframe};
    map.Apply(edit);
    memory.reference = keyframe.id;
    memory.landmarks = map.At(keyframe.id).landmarks;
  }

  PointWorld world;
  Map map;
  TrackMemory memory;
};

TEST_F(TrackFrameTest, FindsTheNextFrame) {
  const Eigen::Isometry3d truth = At(0.03, 0.05, 0.5);
  const auto found = TrackFrame(map, *world.See(truth, 50'000'000), memory, {}, 8, {});
  ASSERT_TRUE(found);
  EXPECT_LT(Difference(truth.inverse(), found->pose.T_rig_world).norm(), 1e-4);
  EXPECT_EQ(found->local.reference, memory.reference);
}

TEST_F(TrackFrameTest, FindsAFrameThatMotionDidNotPredict) {
  Vector6d wrong;
  wrong << 20, 0, 0, 0, 3, 0;  // per second
  memory.motion = Motion{wrong};
  const Eigen::Isometry3d truth = At(0.02, 0, 1);
  const auto found = TrackFrame(map, *world.See(truth, 50'000'000), memory, {}, 8, {});
  ASSERT_TRUE(found);
  EXPECT_LT(Difference(truth.inverse(), found->pose.T_rig_world).norm(), 1e-4);
}

TEST_F(TrackFrameTest, RecognisesTheReferenceKeyframeFromAfar) {
  const Eigen::Isometry3d truth = At(0.8, 1.0, -12);
  const auto found = TrackFrame(map, *world.See(truth, 50'000'000), memory, {}, 8, {});
  ASSERT_TRUE(found);
  EXPECT_LT(Difference(truth.inverse(), found->pose.T_rig_world).norm(), 1e-4);
}

TEST_F(TrackFrameTest, IsLostWhereNothingIsKnown) {
  EXPECT_FALSE(TrackFrame(map, *world.See(At(0, 0, 180), 50'000'000), memory, {}, 8, {}));
  EXPECT_FALSE(TrackFrame(map, *world.See(At(0, 300), 50'000'000), memory, {}, 8, {}));
}

TEST_F(TrackFrameTest, IsFoundAgainWhereItsMotionHasLed) {
  Vector6d ahead;
  ahead << 0, 0, -0.5, 0, 0, 0;  // of T_rig_world, per second
  const auto two_seconds_later = world.See(At(0.1, 1.1, 1), 2'000'000'000);
  EXPECT_FALSE(FindAgain(map, *two_seconds_later, memory, {}, 8, {}));
  memory.steady_motion = Motion{ahead};
  const auto found = FindAgain(map, *two_seconds_later, memory, {}, 8, {});
  ASSERT_TRUE(found);
  EXPECT_LT(Difference(At(0.1, 1.1, 1).inverse(), found->pose.T_rig_world).norm(), 1e-4);
}

TEST_F(TrackFrameTest, IsNotFoundAgainWhereItsMotionCannotHaveLed) {
  memory.steady_motion = Motion{};
  TrackOptions all_around;
  all_around.dead_reckoning.radius_growth_px_per_s = 200;
  const Eigen::Isometry3d aside = At(0.9, 1.2, 2);
  EXPECT_FALSE(FindAgain(map, *world.See(aside, 2'000'000'000), memory, {}, 8, all_around));
  EXPECT_TRUE(FindAgain(map, *world.See(aside, 3'900'000'000), memory, {}, 8, all_around));
  EXPECT_FALSE(FindAgain(map, *world.See(At(0, 0), 60'000'000'000), memory, {}, 8, all_around));
}

TEST_F(TrackFrameTest, AsksForAKeyframeAfterMotionNotAtRest) {
  const auto at_rest_frame = world.See(At(0, 0.001), 50'000'000);
  const auto at_rest = TrackFrame(map, *at_rest_frame, memory, {}, 8, {});
  ASSERT_TRUE(at_rest);
  EXPECT_FALSE(NeedsKeyframe(map, *at_rest_frame, *at_rest, {}, {}));
  const auto turned_frame = world.See(At(0.2, 0.2, 52), 50'000'000);
  const auto turned = TrackFrame(map, *turned_frame, memory, {}, 8, {});
  ASSERT_TRUE(turned);
  EXPECT_TRUE(NeedsKeyframe(map, *turned_frame, *turned, {}, {}));
}

}  // namespace
}  // namespace aisle::slam
