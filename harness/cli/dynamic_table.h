#pragma once

#include <string>
#include <vector>

#include "harness/bench/dynamic.h"
#include "harness/common/text_layout.h"

namespace aisle {

/// For the terminal: objects by rectangle, large ones over time, pixels, time. `names` are what
/// rows will be called, and DynamicCells their figures.
TextTable DynamicLines(const std::vector<std::string>& names, std::size_t width);
std::vector<std::string> DynamicCells(const DynamicOfView& row);

/// Sums over the stretches of each scene, in the order in which the scenes come; stretches as they
/// are where no scene has two.
std::vector<DynamicOfView> ByScene(const std::vector<DynamicOfView>& stretches);

/// The rows and, where there are several, their sum, as Markdown. Times are left out: a page is
/// read on other machines.
std::string DynamicTable(const std::vector<DynamicOfView>& rows);

}  // namespace aisle
