#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "simulator/motion/recorded_path.h"

namespace aisle::sim {

/// The poses of "FILE.mcap:/topic", in the order of their stamps. Throws std::runtime_error with a
/// sentence that names the file. The simulator does not know the formats of bags: whoever reads
/// scenes whose rig follows one brings the reader, which may be called from several threads.
using BagPoseReader = std::function<std::vector<TimedPose>(const std::string& file_and_topic)>;

/// "drive.mcap:/odom" as its file and "/odom"; any other text as a file and "".
std::pair<std::string, std::string> SplitBagTopic(const std::string& text);

/// Fills `poses`. Returns what is wrong, in a sentence that names the file, or nothing: no reader
/// (an empty one), what the reader says, a pose that is not finite, stamps that do not rise, no
/// pose.
std::string ReadBagPoses(const BagPoseReader& reader, const std::string& file_and_topic,
                         std::vector<TimedPose>* poses);

}  // namespace aisle::sim
