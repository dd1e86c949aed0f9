#pragma once

#include <string>
#include <vector>

#include "harness/judge/compare.h"

namespace aisle {

std::string ToConsole(const std::vector<Comparison>& comparisons, bool color);
std::string ToMarkdown(const std::vector<Comparison>& comparisons);
std::string ToJson(const std::vector<Comparison>& comparisons);
/// The section of a page: what changed first, the rest folded away.

}  // namespace aisle
