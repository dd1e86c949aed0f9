#pragma once

#include <functional>
#include <optional>

#include "slam/map/map.h"
#include "slam/place/place_index.h"
#include "slam/track/track_frame.h"

namespace aisle::slam {

/// Where lost frames are looked for by their looks.
struct Places {
  const Vocabulary* vocabulary = nullptr;  ///< null: keyframes are asked in turn
  const PlaceIndex& index;
};

/// The keyframes that a lost frame is compared with: the last reference, or what stands for it
/// where it is gone, then those that look most alike or, without a vocabulary, a few in turn,
/// others at every `turn`.
std::vector<KeyframeId> KeyframesToAsk(const Map& map, const Frame& frame, KeyframeId reference,
                                       const Places& places, std::int64_t turn);

/// Where the keyframes to ask see the frame: of the poses that are possible, the one with most
/// inliers. In rows of equal racks the first that is asked may be another place that looks alike.
std::optional<FramePose> LocateByLooks(const PlainContext& context, const TrackMemory& memory,
                                       const Places& places, std::int64_t turn,
                                       const std::function<bool(const FramePose&)>& is_possible);

/// Finds a lost frame: where the rig must be by now, else by asking a few keyframes for their view
/// of it, as far as it can be there.
std::optional<FramePose> Relocalise(const PlainContext& context, const TrackMemory& memory,
                                    const Places& places, std::int64_t turn);

}  // namespace aisle::slam
