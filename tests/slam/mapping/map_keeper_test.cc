#include "slam/mapping/map_keeper.h"

#include <gtest/gtest.h>

#include "slam/map/successor.h"
#include "tests/slam/mapping/ring_world.h"

namespace aisle::slam {
namespace {

/// What a step of the made-up policy did, as a landmark's position tells.
constexpr double kWhole = 1, kHurried = 2, kGivenUp = 3;

/// A step that leaves a landmark of its own on the keyframe's last feature.
MappingStep::Work Leave(double mark) {
  return [mark](Map map, KeyframeId newest, const MappingTools&) {
    Landmark landmark;
    landmark.position = {mark, 0, 5};
    landmark.observations = {{newest, static_cast<int>(map.At(newest).landmarks.size()) - 1}};
    landmark.created_by = newest;
    MapEdit edit;
    edit.new_landmarks = {landmark};
    map.Apply(edit);
    MappingResult result;
    result.map = std::move(map);
    result.keyframe = newest;
    return result;
  };
}

/// Mapping takes four frames, one where keyframes wait.
class MapKeeperTest : public testing::TestWithParam<bool> {
 protected:
  MapKeeperTest()
      : keeper({}, Options(), {{4, Leave(kWhole), Leave(kHurried), 1, Leave(kGivenUp)}},
               std::nullopt) {
    keeper.AddRoot(NextKeyframe());
  }

  static MapKeeperOptions Options() {
    MapKeeperOptions options;
    options.schedule.background = GetParam();
    return options;
  }

  /// Features with a new landmark each, and two more without.
  MapEdit NextKeyframe(int landmarks = 1) const {
    const int features = landmarks + 2;
    auto frame = std::make_shared<Frame>();
    for (int i = 0; i < features; ++i) {
      frame->features.keypoints.emplace_back();
      frame->features.descriptors.emplace_back();
      frame->measurements.push_back({{10.0 * i, 10, 20}, 1, 1});
    }
    Keyframe keyframe;
    keyframe.id = keeper.map().NextKeyframeId();
    keyframe.frame = frame;
    if (keyframe.id.value > 0) keyframe.parent = {keyframe.id.value - 1};
    keyframe.landmarks.resize(static_cast<std::size_t>(features));
    MapEdit edit;
    edit.new_keyframes = {keyframe};
    for (int i = 0; i < landmarks; ++i) {
      Landmark landmark;
      landmark.position = {100.0 + static_cast<double>(keyframe.id.value), 1.0 * i, 5};
      landmark.observations = {{keyframe.id, i}};
      landmark.created_by = keyframe.id;
      edit.new_landmarks.push_back(landmark);
    }
    return edit;
  }

  MapKeeper::Taken Take(std::int64_t frame) { return keeper.TakeDueWork(frame, stage_ms); }

  /// What mapping has left on a keyframe; 0: nothing (yet).
  double MarkOn(int keyframe) const {
    const Landmark* landmark =
        keeper.map().Find(keeper.map().At(KeyframeId{keyframe}).landmarks.back());
    return landmark ? landmark->position.x() : 0;
  }

  MapKeeper keeper;
  std::map<std::string, double> stage_ms;
};

TEST_P(MapKeeperTest, AKeyframeShowsAtOnceAndItsMappingWhenItIsDue) {
  keeper.WorkIn(NextKeyframe(), 10);
  EXPECT_TRUE(keeper.map().Find(KeyframeId{1}));
  Take(13);
  EXPECT_TRUE(keeper.busy());
  EXPECT_EQ(MarkOn(1), 0);
  Take(14);
  EXPECT_FALSE(keeper.busy());
  EXPECT_EQ(MarkOn(1), kWhole);
}

TEST_P(MapKeeperTest, KeyframesThatWaitShowAndAreWorkedInOneByOne) {
  keeper.WorkIn(NextKeyframe(), 10);
  for (int frame = 11; frame <= 13; ++frame) keeper.WorkIn(NextKeyframe(), frame);
  EXPECT_EQ(keeper.waiting(), 3);
  Take(14);
  EXPECT_EQ(keeper.waiting(), 2);
  EXPECT_EQ(keeper.map().keyframes().size(), 5u);
  EXPECT_EQ(MarkOn(1), kWhole);
  EXPECT_EQ(MarkOn(2), 0);
  Take(15), Take(16);
  EXPECT_EQ(MarkOn(2), kHurried);
  EXPECT_EQ(MarkOn(3), kHurried);
  EXPECT_EQ(MarkOn(4), 0);  // nobody waits behind it: it is not hurried
  Take(20);
  EXPECT_EQ(MarkOn(4), kWhole);
  EXPECT_TRUE(keeper.at_rest());
}

TEST_P(MapKeeperTest, LandmarksOfKeyframesThatWaitAreFoundUnderTheirNewIds) {
  keeper.WorkIn(NextKeyframe(), 10);
  keeper.WorkIn(NextKeyframe(), 11);
  const LandmarkId own = keeper.map().At(KeyframeId{2}).landmarks.front();
  // A third keyframe sees that landmark too, before either has been worked in.
  MapEdit third = NextKeyframe();
  third.new_keyframes.front().landmarks[1] = own;
  third.counts = {{own, 5, 4}};
  keeper.WorkIn(third, 12);
  const auto taken = Take(14);
  ASSERT_TRUE(taken.replaced);
  const LandmarkId now = Successor(*taken.replaced, keeper.map(), own);
  EXPECT_NE(now, own);  // the mapper had given that id to another
  EXPECT_EQ(keeper.map().At(now).position.x(), 102);
  EXPECT_EQ(keeper.map().At(KeyframeId{3}).landmarks[1], now);
  EXPECT_EQ(keeper.map().At(now).predicted, 5);
}

TEST_P(MapKeeperTest, LandmarksOfOneKeyframeThatWaitsAreNotTakenForEachOther) {
  keeper.WorkIn(NextKeyframe(), 10);
  keeper.WorkIn(NextKeyframe(4), 11);
  const std::vector<LandmarkId> own = keeper.map().At(KeyframeId{2}).landmarks;
  MapEdit third = NextKeyframe(0);
  third.new_keyframes.front().landmarks[0] = own[2];
  third.counts = {{own[2], 5, 4}};
  keeper.WorkIn(third, 12);
  const auto taken = Take(14);
  ASSERT_TRUE(taken.replaced);
  // What the mapper has placed takes the first of their ids, and all of them move up.
  const Landmark* shifted = keeper.map().Find(own[2]);
  ASSERT_TRUE(shifted);
  ASSERT_EQ(shifted->created_by, KeyframeId{2});
  for (std::size_t i = 0; i < 4; ++i) {
    const LandmarkId now = Successor(*taken.replaced, keeper.map(), own[i]);
    ASSERT_TRUE(now.valid());
    EXPECT_EQ(keeper.map().At(now).position.y(), 1.0 * static_cast<double>(i));
  }
  const Landmark& seen = keeper.map().At(keeper.map().At(KeyframeId{3}).landmarks[0]);
  EXPECT_EQ(seen.position.y(), 2);
  EXPECT_EQ(seen.predicted, 5);
}

TEST_P(MapKeeperTest, WhatIsGivenUpIsSeenAtTheNextFrame) {
  keeper.WorkIn(NextKeyframe(), 10);
  keeper.Hurry(11);
  Take(11);
  EXPECT_EQ(MarkOn(1), 0);
  Take(12);
  EXPECT_EQ(MarkOn(1), kGivenUp);
  keeper.Hurry(12);  // nothing to give up
  EXPECT_TRUE(keeper.at_rest());
}

TEST_P(MapKeeperTest, FinishingLeavesNobodyWaiting) {
  for (int frame = 10; frame < 14; ++frame) keeper.WorkIn(NextKeyframe(), frame);
  keeper.FinishWork();
  EXPECT_EQ(keeper.waiting(), 0);
  for (int k = 1; k <= 4; ++k) EXPECT_GT(MarkOn(k), 0) << k;
}

TEST_P(MapKeeperTest, FinishingTellsUnderWhichIdsLandmarksAre) {
  keeper.WorkIn(NextKeyframe(), 10);
  keeper.WorkIn(NextKeyframe(), 11);
  keeper.WorkIn(NextKeyframe(), 12);
  const LandmarkId own = keeper.map().At(KeyframeId{3}).landmarks.front();
  const auto replaced = keeper.FinishWork();
  ASSERT_TRUE(replaced);
  const LandmarkId now = Successor(*replaced, keeper.map(), own);
  EXPECT_NE(now, own);  // work of several steps has given that id to another
  EXPECT_EQ(keeper.map().At(now).position.x(), 103);
  EXPECT_FALSE(keeper.FinishWork());
}

INSTANTIATE_TEST_SUITE_P(ThreadedAndNot, MapKeeperTest, testing::Bool());

/// A round and a half of a ring, each keyframe of which shows the loops that it is told to.
class LoopsOfAKeeper : public testing::Test {
 protected:
  LoopsOfAKeeper()
      : keeper(ring.camera(), Options(), {{2, Show(), Show(), 2, nullptr}},
               Vocabulary::Train({ring.map().At(KeyframeId{0}).frame->features.descriptors}, {})) {
    keeper.Adopt(ring.map());
  }

  static MapKeeperOptions Options() {
    MapKeeperOptions options;
    options.schedule.background = false;
    options.loop.drift_m = 10;  // the ring's is no odometry's
    return options;
  }

  MappingStep::Work Show() {
    return [this](Map map, KeyframeId newest, const MappingTools& tools) {
      MappingResult result;
      result.words = tools.vocabulary->Describe(map.At(newest).frame->features.descriptors);
      result.map = std::move(map);
      result.keyframe = newest;
      result.loops = shown;
      return result;
    };
  }

  /// A keyframe comes that shows loops `first` to `last` of the second round; what follows is
  /// taken until frame `until`.
  void Drive(int first, int last, std::int64_t until) {
    const std::vector<LoopEdge> all = ring.Loops();
    shown.assign(all.begin() + first, all.begin() + last + 1);
    Keyframe keyframe = keeper.map().At(KeyframeId{63});
    keyframe.id = keeper.map().NextKeyframeId();
    keyframe.parent = {63};
    keyframe.landmarks.assign(keyframe.landmarks.size(), {});
    MapEdit edit;
    edit.new_keyframes = {keyframe};
    keeper.WorkIn(edit, frame);
    while (++frame <= until) closed += keeper.TakeDueWork(frame, stage_ms).loop_closed;
  }

  /// What loop `index` of the second round still lacks to be closed.
  double GapM(std::size_t index) const {
    const LoopEdge loop = ring.Loops()[index];
    const Eigen::Isometry3d& T_world_rig = keeper.map().At(loop.current).T_world_rig;
    return ((Correction(keeper.map(), loop) * T_world_rig).translation() -
            T_world_rig.translation())
        .norm();
  }

  const RingWorld ring{{.drift = 1.003, .turn_rad = 0.001, .again = 24}};
  std::vector<LoopEdge> shown;
  MapKeeper keeper;
  std::map<std::string, double> stage_ms;
  std::int64_t frame = 0;
  int closed = 0;
};

TEST_F(LoopsOfAKeeper, OneThatShowsWhileTheMapIsAdjustedIsClosedOnceItIs) {
  Drive(0, 2, 10);
  ASSERT_EQ(closed, 1);
  ASSERT_FALSE(keeper.at_rest());
  ASSERT_GT(GapM(22), 0.05);
  // Another place, and then so many keyframes that anywhere else it would be forgotten.
  Drive(20, 23, 13);
  for (int i = 0; i <= Options().loop.pending_keyframes; ++i) Drive(0, -1, frame + 2);
  ASSERT_EQ(closed, 1);
  ASSERT_FALSE(keeper.at_rest());
  keeper.FinishWork();
  EXPECT_LT(GapM(22), 0.01);
}

TEST_F(LoopsOfAKeeper, APlaceIsNotClosedOverAndOver) {
  Drive(0, 2, 10);
  ASSERT_EQ(closed, 1);
  Drive(0, 3, 13);  // it still shows while the map is adjusted
  ASSERT_FALSE(keeper.at_rest());
  while (++frame < 300) closed += keeper.TakeDueWork(frame, stage_ms).loop_closed;
  EXPECT_EQ(closed, 1);
  EXPECT_TRUE(keeper.at_rest());
}

}  // namespace
}  // namespace aisle::slam
