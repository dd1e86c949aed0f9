#pragma once

#include <string>

#include "harness/record/results.h"
#include "harness/report/paper/tables.h"

namespace aisle {

/// Where a page written by hand takes the tables: all between these two lines is theirs.
inline constexpr const char* kTablesBegin = "<!-- tables begin: written by aisle report -->";
inline constexpr const char* kTablesEnd = "<!-- tables end -->";

/// The page with the tables of these results in that place, under a line that says which program,
/// machine and command they are of. Throws InputError, naming `file`, unless both lines are there
/// once, in order.
std::string WithTables(const std::string& page, const std::string& file, const Results& results);

}  // namespace aisle
