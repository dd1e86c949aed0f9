#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace aisle {

/// Makes a file of what an argument names: SceneFile (harness/io/places.h). For `transform`.
CLI::Validator ByName();

/// The same where no folder is taken: of a name that a folder of scenes shares with a suite, the
/// suite.
CLI::Validator SuiteByName();

/// Throws InputError for the first that is no file, with the name that it may have been meant for.
void CheckAreThere(const std::vector<std::string>& files);

}  // namespace aisle
