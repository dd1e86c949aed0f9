#pragma once

#include <filesystem>
#include <string_view>

namespace aisle {

/// style.css of this folder, in the program: the one style sheet of every report, light and dark,
/// no other resource.
extern const std::string_view kStyleSheet;

/// report.js of this folder, in the program: sorting, filtering, values under the pointer, a view
/// of the tracks that turns. Pages are whole without it, and most policies of CI servers forbid it.
extern const std::string_view kScript;

/// Writes both into the folder, under the names by which every Page asks for them.
void WriteResources(const std::filesystem::path& folder);

}  // namespace aisle
