#pragma once

#include <string>

#include "harness/record/results.h"

namespace aisle {

/// Fixed-width table for people; `color` adds ANSI colours.
std::string ToConsole(const Results& results, bool color);

}  // namespace aisle
