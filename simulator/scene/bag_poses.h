#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "simulator/motion/recorded_path.h"

namespace aisle::sim {

/// The poses of "FILE.mcap:/topic", in the order of their stamps. Throws std::runtime_error with a
/// sentence that names the file.
using BagPoseReader = std::function<std::vector<TimedPose>(const std::string& file_and_topic)>;

/// Says who reads bags, whose format the simulator does not know; the harness does. Once, before
/// scenes are read; may be repeated.
void ReadBagsWith(BagPoseReader reader);

/// "drive.mcap:/odom" as its file and "/odom"; any other text as a file and "".
std::pair<std::string, std::string> SplitBagTopic(const std::string& text);

/// Fills `poses`; what is wrong, or nothing.
std::string ReadBagPoses(const std::string& file_and_topic, std::vector<TimedPose>* poses);

}  // namespace aisle::sim
