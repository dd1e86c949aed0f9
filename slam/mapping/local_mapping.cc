#include "slam/mapping/local_mapping.h"

#include "slam/common/stopwatch.h"
#include "slam/map/landmarks_of.h"

namespace aisle::slam {

void LookForLoops(const Map& map, KeyframeId newest, const Vocabulary* vocabulary,
                  const PlaceIndex& index, const StereoCamera& camera, int levels,
                  const LoopOptions& loop, MappingResult& result) {
  if (!vocabulary) return;
  result.words = vocabulary->Describe(map.At(newest).frame->features.descriptors);
  if (const auto own = FindLoop(map, newest, result.words, index, camera, levels, loop)) {
    result.loops = SeenBeside(map, *own, camera, levels, loop);
    result.loops.push_back(*own);
  }
}

MappingResult MapKeyframe(Map map, KeyframeId newest, const Vocabulary* vocabulary,
                          const PlaceIndex& index, const StereoCamera& camera,
                          const MappingOptions& options, const LoopOptions& loop) {
  MappingResult result;
  {
    const Stopwatch time(result.milliseconds);
    map.Apply(CullLandmarks(map, newest, options.cull));

    const std::vector<KeyframeId> neighbours = FuseNeighbours(map, newest, options.fuse);
    MapEdit triangulated;
    triangulated.new_landmarks =
        TriangulateLandmarks(map, newest, neighbours, camera, options.triangulate);
    map.Apply(triangulated);
    for (const KeyframeId neighbour : neighbours) {
      map.Apply(FuseInto(map, neighbour, LandmarksOf(map, {newest}), camera, options.fuse));
    }
    map.Apply(FuseInto(map, newest, LandmarksOf(map, neighbours), camera, options.fuse));

    const Adjustment adjustment = AdjustLocally(map, newest, camera, options.adjust);
    map.Apply(adjustment.edit);

    const MapEdit culling = CullKeyframes(map, newest, options.cull);
    map.Apply(culling);

    LookForLoops(map, newest, vocabulary, index, camera, options.fuse.levels, loop, result);
    result.map = std::move(map);
    result.keyframe = newest;
    result.culled = culling.removed_keyframes;
    result.adjustment = adjustment.summary;
  }
  return result;
}

}  // namespace aisle::slam
