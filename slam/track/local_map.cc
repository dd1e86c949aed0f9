#include "slam/track/local_map.h"

#include <algorithm>

namespace aisle::slam {
namespace {

/// Keyframes that see any of the landmarks, most first, then newer first.
std::vector<KeyframeId> Observers(const Map& map, const std::vector<LandmarkId>& landmarks) {
  const std::vector<int> shared = CountSeen(map, landmarks);
  std::vector<std::pair<int, KeyframeId>> ranked;
  for (std::size_t i = 0; i < shared.size(); ++i) {
    if (shared[i] > 0) ranked.push_back({shared[i], {static_cast<std::int64_t>(i)}});
  }
  std::sort(ranked.rbegin(), ranked.rend());
  std::vector<KeyframeId> observers;
  for (const auto& [count, keyframe] : ranked) observers.push_back(keyframe);
  return observers;
}

}  // namespace

LocalMap FindLocalMap(const Map& map, const std::vector<LandmarkId>& landmarks,
                      int most_keyframes) {
  LocalMap local;
  local.keyframes = Observers(map, landmarks);
  if (local.keyframes.empty()) return local;
  local.reference = local.keyframes.front();
  const auto most = static_cast<std::size_t>(most_keyframes);
  local.keyframes.resize(std::min(local.keyframes.size(), most));
  constexpr int kFromEach = 3, kExpanded = 3;
  for (std::size_t i = 0; i < std::min<std::size_t>(kExpanded, local.keyframes.size()); ++i) {
    int taken = 0;
    for (const Covisible& neighbour :
         CovisibleKeyframes(map, local.keyframes[i], kLeastCovisible)) {
      if (local.keyframes.size() >= most || taken == kFromEach) break;
      if (std::count(local.keyframes.begin(), local.keyframes.end(), neighbour.keyframe)) continue;
      local.keyframes.push_back(neighbour.keyframe);
      ++taken;
    }
  }
  for (const KeyframeId keyframe : local.keyframes) {
    for (const LandmarkId id : map.At(keyframe).landmarks) {
      if (const Landmark* landmark = map.Find(id)) local.landmarks.push_back(landmark);
    }
  }
  const auto by_slot = [](const Landmark* a, const Landmark* b) { return a->id < b->id; };
  std::sort(local.landmarks.begin(), local.landmarks.end(), by_slot);
  local.landmarks.erase(std::unique(local.landmarks.begin(), local.landmarks.end()),
                        local.landmarks.end());
  return local;
}

}  // namespace aisle::slam
