#include "slam/base/orbslam2_tracking.h"

#include <gtest/gtest.h>

#include "tests/slam/track/point_world.h"

namespace aisle::slam {
namespace {

constexpr std::int64_t kStepNs = 50'000'000;

/// Frames are found by where the last one's motion leads or not at all: no reference keyframe is
/// ever recognised. A frame of this world may begin a map.
SlamOptions ByMotionAlone() {
  SlamOptions options;
  options.base = Base::kOrbSlam2;
  options.orbslam2.first_features = 50;
  options.orbslam2.least_reference_matches = 100000;
  return options;
}

/// The pose that the first `inliers` landmarks of keyframe 0 support.
FramePose PoseOf(const Map& map, int inliers) {
  FramePose pose = PoseOfKeyframe(map, {0});
  pose.matches.resize(static_cast<std::size_t>(inliers));
  pose.pose.inlier.assign(pose.matches.size(), true);
  pose.pose.inliers = inliers;
  return pose;
}

/// A rig that stands at the origin of a map of one keyframe, long after it began.
class OrbSlam2TrackingTest : public testing::Test {
 protected:
  void SetUp() override {
    map.Apply(policy.Begin(world.See(At(0, 0), 0), Drive(0))->edit);
    memory.reference = {0};
  }

  DriveState Drive(std::int64_t frame_number) const {
    return {map, memory, {nullptr, index}, frame_number, false};
  }
  std::shared_ptr<const Frame> FrameAt(std::int64_t frame_number) const {
    return world.See(At(0, 0), frame_number * kStepNs);
  }
  std::optional<FramePose> Find(std::int64_t frame_number) {
    return policy.Find(FrameAt(frame_number), Drive(frame_number));
  }
  void NoteFound(std::int64_t frame_number) {
    const FramePose pose = PoseOfKeyframe(map, memory.reference);
    policy.Note(FrameAt(frame_number), &pose, std::nullopt, Drive(frame_number));
  }
  void NoteLost(std::int64_t frame_number) {
    policy.Note(FrameAt(frame_number), nullptr, std::nullopt, Drive(frame_number));
  }
  KeyframeVerdict Verdict(int inliers, const MapperState& mapper) const {
    return policy.NeedsKeyframe(map, *FrameAt(200), PoseOf(map, inliers), mapper);
  }

  PointWorld world;
  Map map;
  PlaceIndex index;
  TrackMemory memory;
  OrbSlam2Tracking policy{{}, ByMotionAlone()};
};

TEST_F(OrbSlam2TrackingTest, TheMapperHurriesForAKeyframeThatIsWantedWhileItWorks) {
  const int confirmed = map.landmark_count();
  const int wanted = confirmed * 3 / 10, unwanted = confirmed / 2;  // 0.4 of them is the bound
  ASSERT_GT(wanted, 15);
  const MapperState idle, busy{.idle = false};
  EXPECT_TRUE(Verdict(wanted, idle).taken);
  EXPECT_FALSE(Verdict(wanted, idle).hurry);
  EXPECT_TRUE(Verdict(wanted, busy).taken);
  EXPECT_TRUE(Verdict(wanted, busy).hurry);
  for (const MapperState& mapper : {idle, busy}) {
    EXPECT_FALSE(Verdict(unwanted, mapper).taken);
    EXPECT_FALSE(Verdict(unwanted, mapper).hurry);
  }
}

TEST_F(OrbSlam2TrackingTest, ItHurriesThoughTooManyWaitForTheKeyframeToBeTaken) {
  const KeyframeVerdict verdict =
      Verdict(map.landmark_count() * 3 / 10, {.idle = false, .waiting = 3});
  EXPECT_FALSE(verdict.taken);
  EXPECT_TRUE(verdict.hurry);
}

TEST_F(OrbSlam2TrackingTest, NothingIsAskedOfAMapperThatClosesALoop) {
  const KeyframeVerdict verdict =
      Verdict(map.landmark_count() * 3 / 10, {.idle = false, .closing = true});
  EXPECT_FALSE(verdict.taken);
  EXPECT_FALSE(verdict.hurry);
}

TEST_F(OrbSlam2TrackingTest, TwoFramesMakeAMotionAndALostOneForgetsIt) {
  NoteFound(1);
  EXPECT_FALSE(Find(2));  // one frame is no motion
  NoteFound(2);
  EXPECT_TRUE(Find(3));
  NoteLost(3);
  NoteFound(100);
  EXPECT_FALSE(Find(102));
  NoteFound(101);
  EXPECT_TRUE(Find(102));
}

TEST_F(OrbSlam2TrackingTest, TheFirstFramesAfterALossDoNotGoByMotion) {
  NoteFound(1);
  NoteFound(2);
  NoteLost(3);
  NoteFound(100);
  NoteFound(101);
  EXPECT_FALSE(Find(101));  // found_again_frames, counted from when it was found again: two
  EXPECT_TRUE(Find(102));
}

/// As published: the first keyframe after a loss is a second after, where the map has many.
TEST_F(OrbSlam2TrackingTest, AFrameThatIsFoundAgainHasNotSettled) {
  SlamOptions options = ByMotionAlone();
  options.orbslam2.least_reference_matches = 15;
  OrbSlam2Tracking relocalising({}, options);
  DriveState lost = Drive(200);
  lost.lost = true;
  ASSERT_TRUE(relocalising.Find(FrameAt(200), lost));
  for (int i = 1; i <= 30; ++i) {  // a map of many keyframes
    MapEdit more;
    more.new_keyframes.push_back(map.At(KeyframeId{0}));
    more.new_keyframes.back().id = map.NextKeyframeId();
    map.Apply(more);
  }
  const FramePose pose = PoseOf(map, map.landmark_count() * 3 / 10);
  EXPECT_FALSE(relocalising.NeedsKeyframe(map, *FrameAt(200), pose, {}).taken);
  EXPECT_TRUE(relocalising.NeedsKeyframe(map, *FrameAt(221), pose, {}).taken);
}

TEST_F(OrbSlam2TrackingTest, LandmarksAreFollowedWhereTheyHaveBecomeOthers) {
  NoteFound(1);
  NoteFound(2);
  // The keyframe's landmarks have come anew, but for a quarter that is gone.
  const Map before = map;
  MapEdit all_go, most_come;
  for (const Landmark* landmark : before.Landmarks()) {
    all_go.removed_landmarks.push_back(landmark->id);
    if (landmark->id.slot % 4 != 0) most_come.new_landmarks.push_back(*landmark);
  }
  map.Apply(all_go);
  map.Apply(most_come);
  EXPECT_FALSE(Find(3));  // nothing that it knows is there
  policy.CarryOver(before, map);
  const auto found = Find(3);
  ASSERT_TRUE(found);
  EXPECT_GT(found->pose.inliers, map.landmark_count() * 9 / 10);
  for (const Match& match : found->matches) EXPECT_TRUE(map.Find(match.landmark));
}

TEST_F(OrbSlam2TrackingTest, AMapOfAFewKeyframesIsGivenUp) {
  const int least = OrbSlam2Options().least_keyframes_to_keep;
  while (std::ssize(map.keyframes()) <= least) {
    EXPECT_TRUE(policy.GivesUp(map));
    MapEdit edit;
    Keyframe keyframe = map.At(KeyframeId{0});
    keyframe.id = map.NextKeyframeId();
    keyframe.parent = {0};
    edit.new_keyframes = {keyframe};
    map.Apply(edit);
  }
  EXPECT_FALSE(policy.GivesUp(map));
}

}  // namespace
}  // namespace aisle::slam
