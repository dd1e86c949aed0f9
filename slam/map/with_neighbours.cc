#include "slam/map/with_neighbours.h"

namespace aisle::slam {

std::set<KeyframeId> WithNeighbours(const Map& map, const std::set<KeyframeId>& keyframes) {
  std::set<KeyframeId> all = keyframes;
  for (const KeyframeId id : keyframes) {
    for (const Covisible& covisible : CovisibleKeyframes(map, id, kLeastCovisible)) {
      all.insert(covisible.keyframe);
    }
  }
  return all;
}

}  // namespace aisle::slam
