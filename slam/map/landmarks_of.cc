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

}  // namespace aisle::slam
