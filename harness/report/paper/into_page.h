#pragma once

#include <string>

#include "harness/record/results.h"
#include "harness/report/block/block.h"

namespace aisle {

/// The page with the paper's tables of these results in that place, under the lines that say which
/// program, machine and command they are of. Throws InputError as WithBlock does.
std::string WithTables(const std::string& page, const BlockPlace& place, const Results& results);

}  // namespace aisle
