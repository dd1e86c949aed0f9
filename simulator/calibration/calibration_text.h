#pragma once

#include <string>

namespace aisle::sim {

/// What a calibration file holds, without the byte order mark that some editors set before UTF-8.
/// Throws std::runtime_error where it is not a regular file of at most 1 MiB.
std::string CalibrationText(const std::string& file);

}  // namespace aisle::sim
