#pragma once

#include <filesystem>
#include <string>

#include "harness/record/group.h"

namespace aisle {

/// The drive over time on one side, everything else beside it where the screen is wide: of several
/// seeds the median and its band, and the worst one by name. Reads the runs' frames.csv.
std::string SceneCharts(const SceneRuns& scene, const std::filesystem::path& report_dir);

}  // namespace aisle
