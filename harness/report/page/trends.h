#pragma once

#include <string>
#include <vector>

#include "harness/record/history.h"

namespace aisle {

/// How every scene's error went from night to night: a chart per scene and twin. Empty below two
/// nights.
std::string TrendSection(const std::vector<TrendPoint>& points);

}  // namespace aisle
