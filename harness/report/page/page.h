#pragma once

#include <filesystem>
#include <string>

#include "harness/record/group.h"

namespace aisle {

/// A whole page around the body, with a table of the headings that have an id. `root` leads from
/// the page to the report's folder ("", "../").
std::string Page(const std::string& title, const std::string& root, const std::string& body);

enum class SceneLinks { kPages, kAnchors };  ///< where a scene's section stands
std::string LinkTo(const SceneRuns& scene, SceneLinks links);

/// The command that repeats it all, the machine, and the files beside the page.
std::string ProvenanceFooter(const Results& results);

}  // namespace aisle
