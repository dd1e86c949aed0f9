#pragma once

#include <string>

#include "harness/common/text_layout.h"
#include "harness/record/results.h"

namespace aisle {

/// The night for people: a table of its runs, the answer in words, and the verdicts: what passed as
/// a number (the report has each), what failed last, nearest to the prompt.
std::string ToConsole(const Results& results, const TextLook& look);

}  // namespace aisle
