#include "slam/map/landmarks_of.h"

#include <set>

namespace aisle::slam {

std::vector<LandmarkId> LandmarksOf(const Map& map, const std::vector<KeyframeId>& keyframes) {
  std::set<LandmarkId> landmarks;
  for (const KeyframeId id : keyframes) {
    for (const LandmarkId landmark : map.At(id).landmarks) {
      if (landmark.valid()) landmarks.insert(landmark);
    }
  }
  return {landmarks.begin(), landmarks.end()};
}

}  // namespace aisle::slam
