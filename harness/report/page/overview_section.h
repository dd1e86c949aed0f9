#pragma once

#include <string>

#include "harness/record/group.h"
#include "harness/report/page/page.h"

namespace aisle {

/// The absolute error of every system on every scene, and what the systems are.
std::string OverviewSection(const std::vector<SceneRuns>& scenes, SceneLinks links);
std::string SystemsSection(const std::vector<SceneRuns>& scenes);

}  // namespace aisle
