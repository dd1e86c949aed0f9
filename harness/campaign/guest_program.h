#pragma once

#include <string>
#include <vector>

#include "harness/contract/external.h"
#include "harness/suite/suite.h"

namespace aisle {

/// The first word of the system's command, where a shell of this machine knows it neither as a
/// program nor as a word of its own; else empty, as of a command that begins with what only a shell
/// can read (a quote, a variable, a bracket).
std::string MissingProgram(const ExternalSystem& system);

/// What a reader should know of a suite's systems before hours of work: "system 'mine': my_slam …".
/// No mistake of the suite: another machine may have it.
std::vector<std::string> NotesOfSystems(const Suite& suite);

}  // namespace aisle
