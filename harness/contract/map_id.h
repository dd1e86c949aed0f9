#pragma once

#include "harness/contract/estimate.h"

namespace aisle {

/// The name among FrameEstimate::counts of which world `T_world_rig` is of.
inline constexpr const char* kMapId = "map_id";

/// Which of the system's worlds the frame's pose is of; 0 where it says nothing of it. It never
/// falls, and rises where a system gives its map up and begins another: poses of different ids are
/// of different worlds, whose places to each other nobody knows. Finish's track is of the last one.
/// So is the live track that is scored: poses of former worlds count as missing. A vehicle that is
/// steered by the system joins each world to the site anew.
inline int MapIdOf(const FrameEstimate& estimate) {
  const auto found = estimate.counts.find(kMapId);
  return found == estimate.counts.end() ? 0 : found->second;
}

}  // namespace aisle
