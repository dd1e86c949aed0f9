#include "slam/local_mapping.h"

#include <chrono>
#include <set>

namespace aisle::slam {
namespace {

/// The landmarks that the given keyframes see.
std::vector<LandmarkId> SeenBy(const Map& map, const std::vector<KeyframeId>& keyframes) {
  std::set<LandmarkId> seen;
  for (const KeyframeId id : keyframes) {
    for (const LandmarkId landmark : map.At(id).landmarks) {
      if (landmark.valid()) seen.insert(landmark);
    }
  }
  return {seen.begin(), seen.end()};
}

}  // namespace

MappingResult MapKeyframe(Map map, KeyframeId newest, const StereoCamera& camera,
                          const MappingOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  map.Apply(CullLandmarks(map, newest, options.cull));

  const std::vector<KeyframeId> neighbours = FuseNeighbours(map, newest, options.fuse);
  for (const KeyframeId neighbour : neighbours) {
    map.Apply(FuseInto(map, neighbour, SeenBy(map, {newest}), camera, options.fuse));
  }
  map.Apply(FuseInto(map, newest, SeenBy(map, neighbours), camera, options.fuse));

  const Adjustment adjustment = AdjustLocally(map, newest, camera, options.adjust);
  map.Apply(adjustment.edit);

  map.Apply(CullKeyframes(map, newest, options.cull));
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
  return {std::move(map), adjustment.summary, took.count()};
}

}  // namespace aisle::slam
