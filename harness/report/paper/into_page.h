#pragma once

#include <string>

#include "harness/record/results.h"
#include "harness/report/block/block.h"

namespace aisle {

/// The page with the paper's tables of these results in that place, under the lines that say which
/// program, machine and command they are of; of them those alone whose title holds `titled`, where
/// that is not empty. Throws InputError as WithBlock does, and where no title holds it.
std::string WithTables(const std::string& page, const BlockPlace& place, const Results& results,
                       const std::string& titled = "");

}  // namespace aisle
