#pragma once

#include <string>
#include <vector>

#include "simulator/simulator.h"

namespace aisle {

/// The poses of "FILE.mcap:/topic", for scenes whose rig follows a bag (sim::BagPoseReader). Throws
/// InputError with a sentence that names the file.
std::vector<sim::TimedPose> ReadPosesOfBag(const std::string& file_and_topic);

}  // namespace aisle
