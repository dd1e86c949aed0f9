#pragma once

#include <CLI/CLI.hpp>

namespace aisle {

/// Makes a file of what an argument names: SceneFile (harness/io/places.h). For `transform`.
CLI::Validator ByName();

}  // namespace aisle
