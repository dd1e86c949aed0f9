#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "harness/plugs/simulated_sequence.h"

namespace aisle {

/// Renders frames of a scene into FOLDER/drive.mcap with all the truth that a bag holds, where
/// asked for with what wheels make of the way from the first frame on (the frames bring motions),
/// and writes /// what ROS and Foxglove like to find beside it. A bag is written whole or not at
/// all: nothing of an earlier one is continued. `scene_file` and `provenance` go along. Throws
/// InputError for a lens that is not rectified.
void RenderBag(const SimulationForExport& simulation, const std::vector<FrameRequest>& frames,
               const std::string& scene_file, const std::map<std::string, std::string>& provenance,
               bool with_odometry, const std::filesystem::path& folder);

}  // namespace aisle
