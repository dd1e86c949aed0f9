#pragma once

#include <filesystem>
#include <string>

#include "harness/record/group.h"

namespace aisle {

/// How a scene whose vehicle the systems steer was driven: a table, the floor from above, the
/// distance from the route over time, and who touched what; empty for a scene without a drive.
/// `root` leads from the page to the report's folder.
std::string DriveSection(const SceneRuns& scene, const std::filesystem::path& report_dir,
                         const std::string& root);

}  // namespace aisle
