#include "slam/map/match_keyframe.h"

namespace aisle::slam {

std::vector<Match> MatchKeyframe(const Map& map, const Keyframe& keyframe, const Frame& frame,
                                 int distance, double ratio) {
  std::vector<Match> by_feature(static_cast<std::size_t>(frame.size()));
  for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
    if (!map.Find(keyframe.landmarks[i])) continue;
    const Descriptor& descriptor = keyframe.frame->features.descriptors[i];
    Match best{keyframe.landmarks[i], -1, 257};
    int second = 257;
    for (int feature = 0; feature < frame.size(); ++feature) {
      const int bits = HammingDistance(
          descriptor, frame.features.descriptors[static_cast<std::size_t>(feature)]);
      if (bits < best.distance) {
        second = best.distance;
        best.feature = feature;
        best.distance = bits;
      } else if (bits < second) {
        second = bits;
      }
    }
    if (best.feature < 0 || best.distance > distance || best.distance > ratio * second) continue;
    Match& held = by_feature[static_cast<std::size_t>(best.feature)];
    if (held.feature < 0 || best.distance < held.distance) held = best;
  }
  std::erase_if(by_feature, [](const Match& match) { return match.feature < 0; });
  return by_feature;
}

}  // namespace aisle::slam
