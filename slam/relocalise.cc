#include "slam/relocalise.h"

namespace aisle::slam {

std::vector<KeyframeId> KeyframesToAsk(const Map& map, const Frame& frame, KeyframeId reference,
                                       const Vocabulary* vocabulary, const PlaceIndex& index,
                                       std::int64_t turn) {
  constexpr std::size_t kAsked = 6;
  std::vector<KeyframeId> asked = {reference};
  if (vocabulary) {
    for (const Lookalike& one : index.Query(vocabulary->Describe(frame.features.descriptors))) {
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

}  // namespace aisle::slam
