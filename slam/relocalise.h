#pragma once

#include "slam/map/map.h"
#include "slam/place/place_index.h"

namespace aisle::slam {

/// The keyframes that a lost frame is compared with: the last reference, then those that look most
/// alike or, without a vocabulary (null), a few in turn, others at every `turn`.
std::vector<KeyframeId> KeyframesToAsk(const Map& map, const Frame& frame, KeyframeId reference,
                                       const Vocabulary* vocabulary, const PlaceIndex& index,
                                       std::int64_t turn);

}  // namespace aisle::slam
