#include "slam/mapping/local_mapping.h"

#include "slam/common/stopwatch.h"
#include "slam/map/cull.h"
#include "slam/map/fuse.h"
#include "slam/map/landmarks_of.h"
#include "slam/map/triangulate_landmarks.h"
#include "slam/optimize/adjust_map.h"
#include "slam/place/find_loop.h"

namespace aisle::slam {

void LookForLoops(const Map& map, KeyframeId newest, const MappingTools& tools,
                  MappingResult& result) {
  const auto& [vocabulary, index, camera, levels, options, loop] = tools;
  if (!vocabulary) return;
  result.words = vocabulary->Describe(map.At(newest).frame->features.descriptors);
  if (const auto own = FindLoop(map, newest, result.words, index, camera, levels, loop)) {
    result.loops = SeenBeside(map, *own, camera, levels, loop);
    result.loops.push_back(*own);
  }
}

MappingResult MapKeyframe(Map map, KeyframeId newest, const MappingTools& tools) {
  const StereoCamera& camera = tools.camera;
  const MappingOptions& options = tools.options;
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
      map.Apply(FuseInto(map, neighbour, LandmarksOf(map, {newest}), camera, tools.levels,
                         options.fuse, FuseBound::kChi2));
    }
    map.Apply(FuseInto(map, newest, LandmarksOf(map, neighbours), camera, tools.levels,
                       options.fuse, FuseBound::kChi2));

    map.Apply(AdjustLocally(map, newest, camera, options.adjust).edit);

    const MapEdit culling = CullKeyframes(map, newest, options.cull);
    map.Apply(culling);

    LookForLoops(map, newest, tools, result);
    result.map = std::move(map);
    result.keyframe = newest;
    result.culled = culling.removed_keyframes;
  }
  return result;
}

}  // namespace aisle::slam
