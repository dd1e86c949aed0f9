#pragma once

#include <compare>
#include <cstdint>

namespace aisle::slam {

/// Keyframes are numbered as they come; a number is never given twice.
struct KeyframeId {
  std::int64_t value = -1;
  bool valid() const { return value >= 0; }
  auto operator<=>(const KeyframeId&) const = default;
};

/// A place in the map's table of landmarks. Places are used again once their landmark is gone, so
/// the generation tells an old tenant's id from the new one's.
struct LandmarkId {
  std::int32_t slot = -1;
  std::int32_t generation = 0;
  bool valid() const { return slot >= 0; }
  auto operator<=>(const LandmarkId&) const = default;
};

}  // namespace aisle::slam
