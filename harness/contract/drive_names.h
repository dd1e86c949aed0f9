#pragma once

#include <array>

#include "harness/contract/drive_log.h"

namespace aisle {

// What files, reports and Python call how a drive ends and what its vehicle is doing, in the order
// of the enumerations.

inline constexpr std::array kDriveEndNames = {"arrived", "contact", "no progress", "timeout",
                                              "failed"};
inline constexpr std::array kDriveModeNames = {"driving", "waiting", "degraded",
                                               "stopped", "scanner", "arrived"};

inline const char* Name(DriveEnd end) { return kDriveEndNames.at(static_cast<std::size_t>(end)); }
inline const char* Name(DriveMode mode) {
  return kDriveModeNames.at(static_cast<std::size_t>(mode));
}

}  // namespace aisle
