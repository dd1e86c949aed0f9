#pragma once

#include <map>
#include <optional>
#include <string>

namespace aisle {

/// Milliseconds of a frame in the caller's thread, those that a camera's rate must leave room for.
struct FrontEndMs {
  double dynamic = 0;   ///< until it is known what moves
  double tracking = 0;  ///< the rest: features, stereo, pose, waiting for the map

  double total() const { return dynamic + tracking; }
};

/// From a system's own stages, as FrameEstimate names them; nothing where it names none of these.
std::optional<FrontEndMs> FrontEndOf(const std::map<std::string, double>& stage_ms);

}  // namespace aisle
