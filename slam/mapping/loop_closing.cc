#include "slam/mapping/loop_closing.h"

#include <algorithm>
#include <map>

#include "slam/camera/se3.h"
#include "slam/common/stopwatch.h"
#include "slam/map/landmarks_of.h"

namespace aisle::slam {
namespace {

/// The landmarks of a keyframe and its neighbours.
std::vector<LandmarkId> LandmarksAround(const Map& map, KeyframeId id, const FuseOptions& options) {
  std::vector<KeyframeId> keyframes = FuseNeighbours(map, id, options);
  keyframes.push_back(id);
  return LandmarksOf(map, keyframes);
}

}  // namespace

Map CloseLoop(Map map, const std::vector<LoopEdge>& loops, const StereoCamera& camera,
              const LoopSpreadOptions& spread, const FuseOptions& fuse) {
  const auto best =
      std::max_element(loops.begin(), loops.end(),
                       [](const LoopEdge& a, const LoopEdge& b) { return a.inliers < b.inliers; });
  map.Apply(JoinParts(map, *best));
  map.Apply(SpreadLoops(map, loops, spread));
  for (const LoopEdge& loop : loops) {
    if (!map.Find(loop.current) || !map.Find(loop.matched)) continue;
    const std::vector<LandmarkId> old_place = LandmarksAround(map, loop.matched, fuse);
    std::vector<KeyframeId> new_views = FuseNeighbours(map, loop.current, fuse);
    new_views.push_back(loop.current);
    for (const KeyframeId view : new_views) {
      map.Apply(FuseInto(map, view, old_place, camera, fuse));
    }
  }
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
