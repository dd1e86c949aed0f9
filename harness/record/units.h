#pragma once

#include <string>

#include "harness/record/results.h"

namespace aisle {

/// Throws InputError at the first score with a value whose unit is none that this program gives it:
/// metres are never to be held against millimetres. `file` is what the message calls the results.
void CheckUnits(const Results& results, const std::string& file);

}  // namespace aisle
