#pragma once

#include <filesystem>
#include <string>

#include "harness/record/group.h"

namespace aisle {

/// A whole page around the body. `root` leads from the page to the report's folder ("", "../").
std::string Page(const std::string& title, const std::string& root, const std::string& body);

enum class SceneLinks { kPages, kAnchors };  ///< where a scene's section stands
/// Verdict first, what is broken leading to its scene; then the score table over all scenes.
std::string VerdictSection(const Results& results, const std::vector<SceneRuns>& scenes,
                           SceneLinks links);
std::string OverviewSection(const std::vector<SceneRuns>& scenes, SceneLinks links);
std::string ProvenanceFooter(const Results& results);

/// Everything about one version of one scene: scores, charts, pictures, times, how to run it again.
/// Reads the runs' frames.csv below `report_dir`.
std::string SceneSection(const SceneRuns& scene, const std::filesystem::path& report_dir,
                         const std::string& root);

/// File name of the scene's own page, below the report's folder.
std::string ScenePage(const SceneRuns& scene);

}  // namespace aisle
