#pragma once

#include <cmath>
#include <string>

namespace aisle {

/// How an imperfect network spoils the masks that `oracle` and `semantic` are handed. All zero:
/// perfect masks.
struct MaskErrors {
  /// Standard deviation of the outline's shift per object and frame, pixels: it swells or shrinks.
  double boundary_px = 0;
  int miss_below_px = 0;   ///< objects that show fewer pixels are never found
  double miss_share = 0;   ///< share of the others missed, each for a while, in [0, 1]
  int latency_frames = 0;  ///< the mask belongs to the picture so many frames ago

  bool operator==(const MaskErrors&) const = default;

  /// The first broken rule with name, value and bound; empty when all hold.
  std::string Validate() const {
    if (!(boundary_px >= 0 && boundary_px <= 100)) return "boundary_px: expected 0 to 100";
    if (miss_below_px < 0) return "miss_below_px: expected 0 or more";
    if (!(miss_share >= 0 && miss_share <= 1)) return "miss_share: expected 0 to 1";
    if (latency_frames < 0 || latency_frames > 100) return "latency_frames: expected 0 to 100";
    return {};
  }
};

}  // namespace aisle
