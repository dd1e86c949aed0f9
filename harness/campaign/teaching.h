#pragma once

#include <filesystem>

#include "harness/contract/estimator.h"
#include "harness/loop/closed_drive.h"
#include "harness/run/mask_makers.h"

namespace aisle {

/// Teaches a way, as who commissions a vehicle does: it is led along its course by its true pose
/// while the system looks on; what the system's finished map says along it is the way to drive, and
/// the map is written to `map_file` for the system that drives it.
///
/// Ends the estimator's run. The noise of the pictures is not that of a later drive. Throws
/// SystemFault where the system has poses for less than half of the frames, or its map cannot be
/// written, and what the estimator throws.
TaughtCourse Teach(const DriveScene& scene, Estimator& estimator, const MaskMaker& masks,
                   std::uint64_t seed, const std::filesystem::path& map_file);

}  // namespace aisle
