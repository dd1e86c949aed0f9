#pragma once

#include <filesystem>
#include <string>

#include "harness/record/group.h"

namespace aisle {

/// Everything about one version of one scene: what it says in a sentence, scores, charts, frames,
/// how to run it again. Reads the runs' frames.csv below `report_dir`; `root` leads from the page
/// to that folder ("", "../").
std::string SceneSection(const SceneRuns& scene, const std::filesystem::path& report_dir,
                         const std::string& root);

/// What each system did on the scene, in words: the median error with its spread over seeds, the
/// worst seed by name, and which runs failed.
std::vector<std::string> SceneInWords(const SceneRuns& scene);

/// File name of the scene's own page, below the report's folder.
std::string ScenePage(const SceneRuns& scene);

}  // namespace aisle
