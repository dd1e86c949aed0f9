#include "slam/track/prior_map.h"

#include <gtest/gtest.h>

#include "slam/track/inertia.h"
#include "slam/track/track_measured.h"
#include "tests/slam/track/point_world.h"

namespace aisle::slam {
namespace {

constexpr std::int64_t kStep_ns = 50'000'000;
constexpr KeyframeId kFirstOfDrive{1};

/// The frame as the left camera alone sees it.
Frame WithoutDepth(Frame frame) {
  for (Measurement& measurement : frame.measurements) measurement.sigma_d = 0;
  return frame;
}

/// A map of one keyframe at the world's origin, where the last frame was found. It is from before
/// the drive, but for those landmarks that a test says the drive has brought.
class PriorMapTest : public testing::Test {
 protected:
  /// The world as keyframe 0 has it; of its points the first so many are there only today.
  void Begin(std::size_t of_today) {
    Keyframe keyframe;
    keyframe.id = map.NextKeyframeId();
    keyframe.frame = world.See(At(0, 0), 0);
    keyframe.landmarks.resize(static_cast<std::size_t>(keyframe.frame->size()));
    MapEdit edit;
    edit.new_landmarks = CreateLandmarks(keyframe, {}, {});
    for (Landmark& landmark : edit.new_landmarks) {
      const auto feature = static_cast<std::size_t>(landmark.observations.front().feature);
      const Descriptor& own = keyframe.frame->features.descriptors[feature];
      if (world.IndexOf(own) < of_today) landmark.created_by = kFirstOfDrive;
    }
    edit.new_keyframes = {keyframe};
    map.Apply(edit);
    memory.reference = keyframe.id;
    memory.landmarks = map.At(keyframe.id).landmarks;
  }

  std::optional<PoseInPriorMap> FindByLeftCamera(const Eigen::Isometry3d& T_world_rig,
                                                 KeyframeId first_of_drive = kFirstOfDrive) {
    const Frame frame = WithoutDepth(*world.See(T_world_rig, kStep_ns));
    return FindInPriorMap({map, frame, {}, 8, {}}, memory, first_of_drive);
  }

  PointWorld world;
  Map map;
  TrackMemory memory;
};

TEST_F(PriorMapTest, TellsWhereAFrameWithoutDepthsStands) {
  Begin(0);
  const Eigen::Isometry3d truth = At(0.02, 0.05, 0.4);
  const auto found = FindByLeftCamera(truth);
  ASSERT_TRUE(found);
  EXPECT_LT(Difference(truth, PoseOf(*found, map)).norm(), 1e-3);
  EXPECT_GT(found->covariance.diagonal().minCoeff(), 0);
}

/// Five of six landmarks go along with the rig, which the drive has mapped while all stood.
TEST_F(PriorMapTest, WhoGoesAlongIsNoneOfItsLandmarks) {
  Begin(500);
  world.Move(0, 500, {0, 0, 0.3});
  const Eigen::Isometry3d truth = At(0, 0.3);
  const auto frame = world.See(truth, kStep_ns);
  const PlainContext context{map, *frame, {}, 8, {}};
  const auto captured = TrackFrame(context, memory);
  ASSERT_TRUE(captured);
  EXPECT_GT(Difference(truth.inverse(), captured->pose.T_rig_world).norm(), 0.25);

  memory.motion = EstimateMotion(At(0, 0), At(0, 0.302), 1e-9 * kStep_ns);
  const auto told = FindByLeftCamera(truth);
  ASSERT_TRUE(told);
  EXPECT_LT(Difference(truth, PoseOf(*told, map)).norm(), 0.015);
  const auto found = TrackInPriorMap(context, memory, *told);
  ASSERT_TRUE(found);
  EXPECT_LT(Difference(truth.inverse(), found->pose.T_rig_world).norm(), 0.015);
}

TEST_F(PriorMapTest, SaysNothingWhereTooLittleOfItIsThere) {
  Begin(0);
  EXPECT_FALSE(FindByLeftCamera(At(0, 0), KeyframeId{0}));  // all is of the drive
  // What it has mapped has been moved since, each thing to elsewhere.
  for (std::size_t i = 0; i < 590; ++i) {
    const double angle = 2.4 * static_cast<double>(i);
    world.Move(i, i + 1, {0.08 * std::cos(angle), 0.08 * std::sin(angle), 0});
  }
  EXPECT_FALSE(FindByLeftCamera(At(0, 0)));
}

/// Half a metre of the map's own error, which shows in no motion as both frames have it.
TEST_F(PriorMapTest, MotionBetweenTwoFramesKeepsToTheKeyframeTheyHangOn) {
  Begin(0);
  const auto before = FindByLeftCamera(At(0, 0));
  const auto now = FindByLeftCamera(At(0.01, 0.05, 0.5));
  ASSERT_TRUE(before && now);
  const auto motion = MotionInPriorMap(map, *before, *now, {}, {});
  ASSERT_TRUE(motion);
  EXPECT_LT(Difference(At(0.01, 0.05, 0.5).inverse(), motion->T_now_before).norm(), 1e-3);
  for (int i = 0; i < 6; ++i) EXPECT_GT(motion->covariance(i, i), now->covariance(i, i));

  MapEdit edit;
  edit.poses = {{memory.reference, At(0.5, 0, 3)}};
  map.Apply(edit);
  const auto after = MotionInPriorMap(map, *before, *now, {}, {});
  EXPECT_LT(Difference(motion->T_now_before, after->T_now_before).norm(), 1e-9);
}

/// The rig goes at a metre a second and the camera delivers the last picture once more.
TEST_F(PriorMapTest, ARepeatedPictureDoesNotStopTheRig) {
  Begin(0);
  const auto before = FindByLeftCamera(At(0, 0));
  const auto next = FindByLeftCamera(At(0, 0.05));
  ASSERT_TRUE(before && next);
  Velocity velocity;
  velocity.per_second = Difference(Eigen::Isometry3d::Identity(), At(0, 1).inverse());
  const InertiaOptions inertia;
  const MeasuredMotion expected = Carry(velocity, 1e-9 * kStep_ns, inertia);
  EXPECT_TRUE(MotionInPriorMap(map, *before, *next, expected, inertia));
  EXPECT_FALSE(MotionInPriorMap(map, *before, *before, expected, inertia));
  EXPECT_TRUE(MotionInPriorMap(map, *before, *before, {}, inertia));
}

}  // namespace
}  // namespace aisle::slam
