#pragma once

#include <vector>

#include "slam/map/map.h"

namespace aisle::slam {

/// The part of the map a frame may see.
struct LocalMap {
  KeyframeId reference;                    ///< shares most landmarks with the frame
  std::vector<KeyframeId> keyframes;       ///< most shared first
  std::vector<const Landmark*> landmarks;  ///< seen by those; each once, in a fixed order
};

/// The surroundings of a frame that sees `landmarks`: the keyframes that see them too, then those
/// most covisible with the best of these, `most_keyframes` in all.
LocalMap FindLocalMap(const Map& map, const std::vector<LandmarkId>& landmarks, int most_keyframes);

}  // namespace aisle::slam
