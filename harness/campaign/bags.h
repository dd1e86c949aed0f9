#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/campaign/job.h"

namespace aisle {

/// One bag for each scene, twin and seed: its frames with their truth, and what every system said
/// of them, out of the bags that the runs left; as OUT/bags/SCENE/TWIN/SEED/drive.mcap, with what
/// ROS and Foxglove like to find beside it. Closed drives have bags of their own and are left out.
/// `say` is told of each bag, and of runs without one.
void WriteBags(const std::vector<Job>& jobs, const std::filesystem::path& out,
               const std::function<void(const std::string&)>& say);

}  // namespace aisle
