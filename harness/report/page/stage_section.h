#pragma once

#include <filesystem>
#include <string>

#include "harness/record/group.h"

namespace aisle {

/// How each system found what moves, in the frames whose mask is most wrong, for the first of its
/// seeds that was drawn; empty where none was. Reads the frames.csv of that run.
std::string StageSection(const SceneRuns& scene, const std::filesystem::path& report_dir,
                         const std::string& root);

/// Whether an artifact of this name is the sheet of one frame.
bool IsStageSheet(const std::string& artifact);

}  // namespace aisle
