#pragma once

#include <string>
#include <vector>

#include "harness/common/text_layout.h"
#include "harness/judge/compare.h"
#include "harness/judge/missing.h"

namespace aisle {

/// What changed, and what the old side has and the new one lacks.
std::string ToConsole(const std::vector<Comparison>& comparisons,
                      const std::vector<MissingRuns>& missing, const TextLook& look);
std::string ToMarkdown(const std::vector<Comparison>& comparisons,
                       const std::vector<MissingRuns>& missing);
std::string ToJson(const std::vector<Comparison>& comparisons,
                   const std::vector<MissingRuns>& missing);

}  // namespace aisle
