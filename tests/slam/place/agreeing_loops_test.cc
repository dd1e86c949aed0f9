#include <gtest/gtest.h>

#include "slam/place/find_loop.h"

namespace aisle::slam {
namespace {

Eigen::Isometry3d AtX(double x_m) { return Eigen::Isometry3d(Eigen::Translation3d(x_m, 0, 0)); }

/// A keyframe that sees nothing; without a `parent` it begins a part of the map.
KeyframeId Add(Map& map, double x_m, KeyframeId parent) {
  Keyframe keyframe;
  keyframe.id = map.NextKeyframeId();
  keyframe.frame = std::make_shared<Frame>();
  keyframe.T_world_rig = AtX(x_m);
  keyframe.parent = parent;
  MapEdit edit;
  edit.new_keyframes = {keyframe};
  map.Apply(edit);
  return keyframe.id;
}

/// A drive of ten metres, a keyframe a metre. Half-way the rig is `elsewhere` for so many
/// keyframes, which make a part of the map of their own: a hundred metres off, as far apart each.
Map TenMetres(int elsewhere) {
  Map map;
  KeyframeId last;
  for (int x = 0; x <= 10; ++x) {
    last = Add(map, x, last);
    KeyframeId there;
    for (int k = 1; x == 5 && k <= elsewhere; ++k) there = Add(map, 100 * k, there);
  }
  return map;
}

/// The two newest keyframes see the first one, so that both would have to move by `shift_m`.
std::vector<LoopEdge> LoopsThatShift(const Map& map, double shift_m) {
  std::vector<LoopEdge> loops;
  for (auto at = std::prev(map.keyframes().end(), 2); at != map.keyframes().end(); ++at) {
    loops.push_back({at->first, {0}, AtX(shift_m) * at->second->T_world_rig, 100});
  }
  return loops;
}

LoopOptions FiftiethOfTheWay() {
  LoopOptions options;
  options.drift_share = 0.02;
  options.drift_m = 0.3;
  return options;
}

TEST(AgreeingLoops, ACorrectionIsBoundedByTheWayDriven) {
  const Map map = TenMetres(0);
  EXPECT_EQ(AgreeingLoops(map, LoopsThatShift(map, 0.49), FiftiethOfTheWay()).size(), 2U);
  EXPECT_TRUE(AgreeingLoops(map, LoopsThatShift(map, 0.51), FiftiethOfTheWay()).empty());
}

TEST(AgreeingLoops, KeyframesOfOtherPartsAreNoWay) {
  for (const int elsewhere : {1, 4}) {
    const Map map = TenMetres(elsewhere);
    EXPECT_EQ(AgreeingLoops(map, LoopsThatShift(map, 0.49), FiftiethOfTheWay()).size(), 2U);
    EXPECT_TRUE(AgreeingLoops(map, LoopsThatShift(map, 0.51), FiftiethOfTheWay()).empty());
  }
}

TEST(AgreeingLoops, NothingBoundsACorrectionBetweenParts) {
  Map map = TenMetres(0);
  const KeyframeId first = Add(map, 100, {});
  Add(map, 101, first);
  EXPECT_EQ(AgreeingLoops(map, LoopsThatShift(map, 50), {}).size(), 2U);
}

}  // namespace
}  // namespace aisle::slam
