#pragma once

#include <map>
#include <string>

#include "harness/record/group.h"
#include "harness/report/page/page.h"

namespace aisle {

/// The absolute error of every system on every scene.
std::string OverviewSection(const std::vector<SceneRuns>& scenes, SceneLinks links);
/// What the systems are: ours by their sentence and the options of a variant, others by their
/// command. `sentences` say what the built-in systems are, by name.
std::string SystemsSection(const std::vector<SceneRuns>& scenes,
                           const std::map<std::string, std::string>& sentences);

}  // namespace aisle
