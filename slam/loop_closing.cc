#include "slam/loop_closing.h"

#include <set>

namespace aisle::slam {
namespace {

/// The landmarks of a keyframe and its neighbours.
std::vector<LandmarkId> LandmarksAround(const Map& map, KeyframeId id, const FuseOptions& options) {
  std::vector<KeyframeId> keyframes = FuseNeighbours(map, id, options);
  keyframes.push_back(id);
  std::set<LandmarkId> landmarks;
  for (const KeyframeId keyframe : keyframes) {
    for (const LandmarkId landmark : map.At(keyframe).landmarks) {
      if (landmark.valid()) landmarks.insert(landmark);
    }
  }
  return {landmarks.begin(), landmarks.end()};
}

}  // namespace

Map CloseLoop(Map map, const std::vector<LoopEdge>& loops, const StereoCamera& camera,
              const SlamOptions& options) {
  map.Apply(SpreadLoops(map, loops));
  for (const LoopEdge& loop : loops) {
    if (!map.Find(loop.current) || !map.Find(loop.matched)) continue;
    const std::vector<LandmarkId> old_place =
        LandmarksAround(map, loop.matched, options.mapping.fuse);
    std::vector<KeyframeId> new_views = FuseNeighbours(map, loop.current, options.mapping.fuse);
    new_views.push_back(loop.current);
    for (const KeyframeId view : new_views) {
      map.Apply(FuseInto(map, view, old_place, camera, options.mapping.fuse));
    }
  }
  map.Apply(AdjustGlobally(map, camera, options.global).edit);
  return map;
}

}  // namespace aisle::slam
