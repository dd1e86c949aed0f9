#pragma once

#include <CLI/CLI.hpp>

namespace aisle {

/// Makes a file of what an argument names: SceneFile (harness/io/places.h). For `transform`.
CLI::Validator ByName();

/// The same where no folder is taken: of a name that a folder of scenes shares with a suite, the
/// suite.
CLI::Validator SuiteByName();

}  // namespace aisle
