#pragma once

#include "harness/contract/estimate.h"

namespace aisle {

/// What files, bags and Python call a tracking state.
inline const char* StateName(TrackingState state) {
  switch (state) {
    case TrackingState::kInitializing:
      return "initializing";
    case TrackingState::kTracking:
      return "tracking";
    case TrackingState::kLost:
      break;
  }
  return "lost";
}

}  // namespace aisle
