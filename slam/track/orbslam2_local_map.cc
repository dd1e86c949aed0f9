#include "slam/track/orbslam2_local_map.h"

#include <algorithm>
#include <set>

namespace aisle::slam {
namespace {

/// Keyframes that grow by others, none twice.
class Growing {
 public:
  explicit Growing(std::vector<KeyframeId>& keyframes)
      : keyframes_(keyframes), there_(keyframes.begin(), keyframes.end()) {}

  /// Whether it was new.
  bool Add(KeyframeId id) {
    if (!id.valid() || !there_.insert(id).second) return false;
    keyframes_.push_back(id);
    return true;
  }

 private:
  std::vector<KeyframeId>& keyframes_;
  std::set<KeyframeId> there_;
};

void Grow(const Map& map, std::vector<KeyframeId>& keyframes, const OrbSlam2Options& options) {
  std::multimap<KeyframeId, KeyframeId> children;
  for (const auto& [id, keyframe] : map.keyframes()) children.emplace(keyframe->parent, id);
  const std::vector<KeyframeId> observers = keyframes;
  Growing growing(keyframes);
  for (const KeyframeId observer : observers) {
    if (std::ssize(keyframes) > options.local_keyframes) return;
    std::vector<Covisible> best = CovisibleKeyframes(map, observer, kLeastCovisible);
    best.resize(std::min(best.size(), static_cast<std::size_t>(options.neighbours)));
    for (const Covisible& neighbour : best) {
      if (growing.Add(neighbour.keyframe)) break;
    }
    const auto [first, last] = children.equal_range(observer);
    for (auto child = first; child != last; ++child) {
      if (growing.Add(child->second)) break;
    }
    // No slip of `break`: as published, a new parent ends the search for all observers.
    if (growing.Add(map.At(observer).parent)) return;
  }
}

}  // namespace

LocalMap OrbSlam2LocalMap(const Map& map, const std::vector<LandmarkId>& landmarks,
                          const OrbSlam2Options& options) {
  LocalMap local;
  const std::vector<int> votes = CountSeen(map, landmarks);
  int most = 0;
  for (std::size_t i = 0; i < votes.size(); ++i) {
    if (votes[i] == 0) continue;
    local.keyframes.push_back({static_cast<std::int64_t>(i)});
    if (votes[i] > most) most = votes[i], local.reference = local.keyframes.back();
  }
  Grow(map, local.keyframes, options);
  std::vector<bool> known(static_cast<std::size_t>(map.slot_count()), false);
  for (const KeyframeId keyframe : local.keyframes) {
    for (const LandmarkId id : map.At(keyframe).landmarks) {
      const Landmark* landmark = map.Find(id);
      if (!landmark || known[static_cast<std::size_t>(id.slot)]) continue;
      known[static_cast<std::size_t>(id.slot)] = true;
      local.landmarks.push_back(landmark);
    }
  }
  return local;
}

}  // namespace aisle::slam
