#include "slam/track/relocalise.h"

namespace aisle::slam {

std::vector<KeyframeId> KeyframesToAsk(const Map& map, const Frame& frame, KeyframeId reference,
                                       const Places& places, std::int64_t turn) {
  constexpr std::size_t kAsked = 6;
  std::vector<KeyframeId> asked = {map.StandIn(reference)};
  if (places.vocabulary) {
    const WordVector words = places.vocabulary->Describe(frame.features.descriptors);
    for (const PlaceMatch& one : places.index.Query(words)) {
      if (asked.size() < kAsked) asked.push_back(one.keyframe);
    }
    return asked;
  }
  const auto count = static_cast<std::int64_t>(map.keyframes().size());
  const std::int64_t first = turn * static_cast<std::int64_t>(kAsked - 1);
  for (std::int64_t i = 0; i < count && asked.size() < kAsked; ++i) {
    asked.push_back(std::next(map.keyframes().begin(), (first + i) % count)->first);
  }
  return asked;
}

std::optional<FramePose> LocateByLooks(const PlainContext& context, const TrackMemory& memory,
                                       const Places& places, std::int64_t turn,
                                       const std::function<bool(const FramePose&)>& is_possible) {
  std::optional<FramePose> best;
  for (const KeyframeId id :
       KeyframesToAsk(context.map, context.frame, memory.reference, places, turn)) {
    auto found = LocateByKeyframe(context, id);
    if (!found || !is_possible(*found)) continue;
    if (!best || found->pose.inliers > best->pose.inliers) best = std::move(found);
  }
  return best;
}

std::optional<FramePose> Relocalise(const PlainContext& context, const TrackMemory& memory,
                                    const Places& places, std::int64_t turn) {
  if (auto pose = FindAgain(context, memory)) return pose;
  return LocateByLooks(context, memory, places, turn,
                       [&](const FramePose& found) { return CanBeThere(context, memory, found); });
}

}  // namespace aisle::slam
