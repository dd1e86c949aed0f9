#include "slam/mapping/loop_closing.h"

#include <algorithm>
#include <iterator>
#include <set>

#include "slam/camera/se3.h"
#include "slam/common/stopwatch.h"
#include "slam/map/fuse.h"
#include "slam/map/landmarks_of.h"
#include "slam/map/with_neighbours.h"

namespace aisle::slam {
namespace {

/// The two visits of a place, around the ends of loops: the keyframes that see it now, and those
/// that saw it then. Who stands beside both is of the older one: it does not move.
struct Visits {
  std::vector<KeyframeId> now, then;
};

Visits VisitsOf(const Map& map, const std::vector<LoopEdge>& loops) {
  std::set<KeyframeId> current, matched;
  for (const LoopEdge& loop : loops) {
    current.insert(loop.current);
    matched.insert(loop.matched);
  }
  const std::set<KeyframeId> now = WithNeighbours(map, current);
  const std::set<KeyframeId> then = WithNeighbours(map, matched);
  Visits visits;
  std::ranges::set_difference(now, then, std::back_inserter(visits.now));
  visits.then.assign(then.begin(), then.end());
  return visits;
}

/// What joins the two visits in a map in which they stand as the loop says: the landmarks that both
/// saw become one. Edits by their order.
std::vector<MapEdit> JoinVisits(Map map, const Visits& visits, const StereoCamera& camera,
                                int levels, const FuseOptions& fuse) {
  std::vector<MapEdit> edits;
  for (const KeyframeId view : visits.now) {
    // Asked anew for every view: the one before may have put other landmarks in their place.
    edits.push_back(FuseInto(map, view, LandmarksOf(map, visits.then), camera, levels, fuse,
                             FuseBound::kRadius));
    map.Apply(edits.back());
  }
  return edits;
}

/// Every pair of keyframes that has come to share landmarks, as it stands: one of this visit, and
/// one of which it knew nothing `before`.
std::vector<LoopEdge> NewPairs(const Map& before, const Map& joined, const Visits& visits) {
  std::vector<LoopEdge> pairs;
  for (const KeyframeId now : visits.now) {
    const std::set<KeyframeId> known = WithNeighbours(before, {now});
    for (const Covisible& other : CovisibleKeyframes(joined, now, kLeastCovisible)) {
      if (known.contains(other.keyframe) || std::ranges::binary_search(visits.now, other.keyframe))
        continue;
      pairs.push_back({now, other.keyframe,
                       joined.At(other.keyframe).T_world_rig.inverse() * joined.At(now).T_world_rig,
                       other.shared});
    }
  }
  return pairs;
}

}  // namespace

Map CloseLoop(Map map, const std::vector<LoopEdge>& loops, const StereoCamera& camera, int levels,
              const LoopSpreadOptions& spread, const FuseOptions& fuse) {
  const auto best =
      std::max_element(loops.begin(), loops.end(),
                       [](const LoopEdge& a, const LoopEdge& b) { return a.inliers < b.inliers; });
  map.Apply(JoinParts(map, *best));
  const Visits visits = VisitsOf(map, loops);
  Map moved = map;
  moved.Apply(MoveRigidly(map, visits.now, Correction(map, *best)));
  const std::vector<MapEdit> joining = JoinVisits(moved, visits, camera, levels, fuse);
  for (const MapEdit& edit : joining) moved.Apply(edit);
  std::vector<LoopEdge> edges = loops;
  std::ranges::copy(NewPairs(map, moved, visits), std::back_inserter(edges));
  map.Apply(SpreadLoops(map, edges, spread));
  for (const MapEdit& edit : joining) map.Apply(edit);
  MapEdit closed;
  for (const LoopEdge& loop : loops) closed.closed_loops.push_back({loop.current, loop.matched});
  map.Apply(closed);
  return map;
}

GlobalCorrection CorrectGlobally(Map map, const StereoCamera& camera,
                                 const GlobalAdjustmentOptions& options) {
  double ms = 0;
  MapEdit adjusted = Timed(ms, [&] { return AdjustGlobally(map, camera, options).edit; });
  return {std::move(map), std::move(adjusted), ms};
}

MapEdit CarryOver(const Map& now, const GlobalCorrection& correction) {
  std::map<KeyframeId, Eigen::Isometry3d> T_new_old;  // of the world around each keyframe
  for (const auto& [keyframe, T_world_rig] : correction.adjusted.poses) {
    T_new_old[keyframe] = T_world_rig * correction.before.At(keyframe).T_world_rig.inverse();
  }
  MapEdit edit;
  for (const auto& [id, keyframe] : now.keyframes()) {
    // Parents are older than their children: theirs is known by now.
    const auto parent = T_new_old.find(keyframe->parent);
    const Eigen::Isometry3d inherited =
        parent == T_new_old.end() ? Eigen::Isometry3d::Identity() : parent->second;
    const bool is_new = correction.before.Find(id) == nullptr;
    const Eigen::Isometry3d& correction_here =
        T_new_old.try_emplace(id, is_new ? inherited : Eigen::Isometry3d::Identity()).first->second;
    edit.poses.push_back({id, Normalized(correction_here * keyframe->T_world_rig)});
  }
  std::map<LandmarkId, Eigen::Vector3d> adjusted;
  for (const auto& [landmark, position] : correction.adjusted.positions) {
    adjusted[landmark] = position;
  }
  for (const Landmark* landmark : now.Landmarks()) {
    const Landmark* before = correction.before.Find(landmark->id);
    const auto place = adjusted.find(landmark->id);
    const bool untouched =
        before && place != adjusted.end() && before->position == landmark->position;
    const KeyframeId first = landmark->observations.front().keyframe;
    edit.positions.push_back(
        {landmark->id, untouched ? place->second : T_new_old.at(first) * landmark->position});
  }
  edit.cuts = correction.adjusted.cuts;
  return edit;
}

}  // namespace aisle::slam
