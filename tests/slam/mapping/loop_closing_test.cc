#include "slam/mapping/loop_closing.h"

#include <gtest/gtest.h>

#include "tests/slam/mapping/ring_world.h"

namespace aisle::slam {
namespace {

/// 50 m with 1 % too long steps and a quarter of a degree a metre in all.
const RingWorld& Ring() {
  static const RingWorld ring({.drift = 1.01, .turn_rad = 0.003});
  return ring;
}

/// What a loop still lacks to be closed.
double GapM(const Map& map, const LoopEdge& loop) {
  const Eigen::Isometry3d T_matched_current =
      map.At(loop.matched).T_world_rig.inverse() * map.At(loop.current).T_world_rig;
  return (T_matched_current.translation() - loop.T_matched_current.translation()).norm();
}

/// Landmarks that both see.
int SharedBy(const Map& map, KeyframeId one, KeyframeId other) {
  for (const Covisible& covisible : CovisibleKeyframes(map, one, 1)) {
    if (covisible.keyframe == other) return covisible.shared;
  }
  return 0;
}

TEST(LoopClosing, SpreadingALoopTakesMostOfTheDriftAway) {
  const double drift_m = Ring().WorstErrorM(Ring().map());
  ASSERT_GT(drift_m, 0.5);
  Map map = Ring().map();
  map.Apply(SpreadLoops(map, Ring().Loops(), {}));
  EXPECT_LT(Ring().WorstErrorM(map), 0.4 * drift_m);
  // The new visit and the old one are one place again.
  for (const LoopEdge& loop : Ring().Loops()) EXPECT_LT(GapM(map, loop), 0.05);
}

TEST(LoopClosing, LandmarksMoveWithTheKeyframesThatSeeThem) {
  Map map = Ring().map();
  map.Apply(SpreadLoops(map, Ring().Loops(), {}));
  // Neighbours are corrected nearly alike; a landmark left behind would be hundreds of pixels off.
  for (const Landmark* landmark : map.Landmarks()) {
    for (const Observation& observation : landmark->observations) {
      const Keyframe& keyframe = map.At(observation.keyframe);
      const Eigen::Vector3d uvd =
          Project(Ring().camera(), keyframe.T_world_rig.inverse() * landmark->position);
      const auto& measured =
          keyframe.frame->measurements[static_cast<std::size_t>(observation.feature)];
      ASSERT_LT((uvd - measured.uvd).head<2>().norm(), 80) << "keyframe " << keyframe.id.value;
    }
  }
}

TEST(LoopClosing, WithoutLoopsNothingIsSpread) {
  Map map = Ring().map();
  map.Apply(SpreadLoops(map, {}, {}));
  EXPECT_NEAR(Ring().WorstErrorM(map), Ring().WorstErrorM(Ring().map()), 1e-6);
}

TEST(LoopClosing, AClosedLoopIsOnePlaceAndAsExactAsItsMeasurements) {
  Map closed = CloseLoop(Ring().map(), Ring().Loops(), Ring().camera(), 8, {}, {});
  closed.Apply(CarryOver(closed, CorrectGlobally(closed, Ring().camera(), {})));
  EXPECT_LT(Ring().WorstErrorM(closed), 0.02);
  // What was mapped twice is one: every second visit shares its landmarks with the first.
  EXPECT_LT(closed.landmark_count(), Ring().map().landmark_count());
  for (const LoopEdge& loop : Ring().Loops()) {
    EXPECT_GE(SharedBy(closed, loop.current, loop.matched), 30) << loop.current.value;
  }
}

TEST(LoopClosing, ALoopClosesHoweverManyNeighboursHoldOntoTheDrift) {
  // Keyframes each 20 cm: some twenty neighbours share a hundred landmarks with each.
  const RingWorld ring(
      {.drift = 1.01, .turn_rad = 0.0004, .round = 240, .again = 8, .points = 8000});
  ASSERT_GT(CovisibleKeyframes(ring.map(), {120}, LoopSpreadOptions().strong_shared).size(), 15u);
  std::vector<LoopEdge> loops = ring.Loops();
  loops.erase(loops.begin(), loops.end() - 3);  // as many as it takes to agree
  ASSERT_GT(GapM(ring.map(), loops.back()), 0.5);
  const Map closed = CloseLoop(ring.map(), loops, ring.camera(), 8, {}, {});
  for (const LoopEdge& loop : ring.Loops()) {
    EXPECT_LT(GapM(closed, loop), 0.01) << loop.current.value;
    EXPECT_GT(SharedBy(closed, loop.current, loop.matched), 100) << loop.current.value;
  }
}

TEST(LoopClosing, WhereTheVisitsMeetIsSaidByTheLoopOfMostInliers) {
  std::vector<LoopEdge> loops = Ring().Loops();
  for (LoopEdge& loop : loops) loop.inliers = 90;
  // One that hardly anything confirms, elsewhere in the order each time, is half a metre off.
  for (std::size_t worst = 0; worst < loops.size(); ++worst) {
    std::vector<LoopEdge> unequal = loops;
    unequal[worst].inliers = 5;
    unequal[worst].T_matched_current.translation().y() += 0.5;
    unequal[(worst + 2) % loops.size()].inliers = 100;
    const Map closed = CloseLoop(Ring().map(), unequal, Ring().camera(), 8, {}, {});
    for (const LoopEdge& loop : Ring().Loops()) {
      EXPECT_GE(SharedBy(closed, loop.current, loop.matched), 30) << loop.current.value;
    }
  }
}

TEST(LoopClosing, ALoopClosedBeforeStaysClosed) {
  // So few features that no two keyframes share a hundred landmarks.
  const RingWorld ring({.drift = 1.003, .turn_rad = 0.001, .again = 24, .points = 1200});
  const std::vector<LoopEdge> all = ring.Loops();
  const std::vector<LoopEdge> first(all.begin(), all.begin() + 3), second(all.end() - 3, all.end());
  const Map once = CloseLoop(ring.map(), first, ring.camera(), 8, {}, {});
  EXPECT_EQ(once.closed_loops().size(), first.size());
  ASSERT_GT(GapM(once, second.back()), 0.1);
  const Map twice = CloseLoop(once, second, ring.camera(), 8, {}, {});
  for (const LoopEdge& loop : first) EXPECT_LT(GapM(twice, loop), 0.005) << loop.current.value;
  for (const LoopEdge& loop : second) EXPECT_LT(GapM(twice, loop), 0.005) << loop.current.value;
}

TEST(LoopClosing, GivesTheSameBitsAgain) {
  const Map a = CloseLoop(Ring().map(), Ring().Loops(), Ring().camera(), 8, {}, {});
  const Map b = CloseLoop(Ring().map(), Ring().Loops(), Ring().camera(), 8, {}, {});
  for (const auto& [id, keyframe] : a.keyframes()) {
    EXPECT_EQ(keyframe->T_world_rig.matrix(), b.At(id).T_world_rig.matrix()) << id.value;
  }
}

TEST(LoopClosing, WhatIsMappedDuringTheGlobalAdjustmentMovesAlong) {
  const Map closed = CloseLoop(Ring().map(), Ring().Loops(), Ring().camera(), 8, {}, {});
  const GlobalCorrection correction = CorrectGlobally(closed, Ring().camera(), {});
  // Meanwhile a keyframe joins and sees a landmark of its own.
  Map grown = closed;
  const KeyframeId parent = Ring().Loops().back().current;
  Keyframe keyframe = closed.At(parent);
  keyframe.id = grown.NextKeyframeId();
  keyframe.parent = parent;
  keyframe.landmarks.assign(keyframe.landmarks.size(), {});
  Landmark landmark;
  landmark.position = keyframe.T_world_rig * Eigen::Vector3d(0, 0, 4);
  landmark.observations = {{keyframe.id, 0}};
  MapEdit edit;
  edit.new_keyframes = {keyframe};
  edit.new_landmarks = {landmark};
  grown.Apply(edit);
  grown.Apply(CarryOver(grown, correction));

  const Eigen::Isometry3d& moved = grown.At(keyframe.id).T_world_rig;
  EXPECT_TRUE(moved.isApprox(grown.At(parent).T_world_rig, 1e-9));
  EXPECT_FALSE(moved.isApprox(closed.At(parent).T_world_rig, 1e-6));
  const Landmark& carried = grown.At(grown.At(keyframe.id).landmarks[0]);
  EXPECT_LT((moved.inverse() * carried.position - Eigen::Vector3d(0, 0, 4)).norm(), 1e-9);
}

TEST(LoopClosing, GlobalAdjustmentLeavesATrueMapAlone) {
  const RingWorld exact({});
  Map map = exact.map();
  map.Apply(AdjustGlobally(map, exact.camera(), {}).edit);
  EXPECT_LT(exact.WorstErrorM(map), 1e-3);
}

}  // namespace
}  // namespace aisle::slam
