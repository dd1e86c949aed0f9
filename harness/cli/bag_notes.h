#pragma once

#include <string>
#include <vector>

#include "harness/suite/suite.h"

namespace aisle {

/// What a reader of the file should know, on stderr: that it ends in the middle of a record, say.
void TellNotes(const std::string& file, const std::vector<std::string>& notes);

/// The same of every recording among the suites' scenes.
void TellNotesOfScenes(const std::vector<Suite>& suites);

}  // namespace aisle
