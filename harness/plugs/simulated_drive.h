#pragma once

#include <memory>

#include "harness/loop/drive_scene.h"
#include "harness/plugs/simulated_sequence.h"
#include "harness/plugs/wheel_odometry.h"

namespace aisle {

/// Whether a scene's vehicle is steered by what the system says (`drive:`). Throws InputError for a
/// bad scene.
bool IsDriveScene(const std::string& scene_file);

/// Of the vehicle that the scene's `drive` describes, and how they err; of a scene without one
/// those of any vehicle. Throws likewise.
Wheels WheelsOfScene(const std::string& scene_file);

/// A scene with a `drive` as a world for closed drives. `content_hash` may be null. Throws as
/// OpenSimulation, and InputError where the scene has no `drive`.
std::unique_ptr<DriveScene> OpenSimulatedDrive(const SimulatedSequenceOptions& options,
                                               std::uint64_t* content_hash = nullptr);

}  // namespace aisle
