#include "slam/map/landmarks_of.h"

#include <algorithm>

namespace aisle::slam {

std::vector<LandmarkId> LandmarksOf(const Map& map, const std::vector<KeyframeId>& keyframes) {
  std::vector<LandmarkId> landmarks;
  for (const KeyframeId id : keyframes) {
    for (const LandmarkId landmark : map.At(id).landmarks) {
      if (landmark.valid()) landmarks.push_back(landmark);
    }
  }
  std::sort(landmarks.begin(), landmarks.end());
  landmarks.erase(std::unique(landmarks.begin(), landmarks.end()), landmarks.end());
  return landmarks;
}

std::vector<const Landmark*> FindAll(const Map& map, const std::vector<LandmarkId>& landmarks) {
  std::vector<const Landmark*> found;
  for (const LandmarkId id : landmarks) {
    if (const Landmark* landmark = map.Find(id)) found.push_back(landmark);
  }
  return found;
}

}  // namespace aisle::slam
