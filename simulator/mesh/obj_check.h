#pragma once

#include <string_view>

namespace aisle::sim {

/// Whether the first statement of a text is one of an OBJ file.
bool LooksLikeObj(std::string_view text);

/// Holds every line of an OBJ file against the grammar before the parser sees it, which believes
/// what it reads: numbers finite, faces of three corners or more, indices of things that exist.
/// Curves and free-form surfaces are refused. Throws ImportError with the line.
void CheckObj(std::string_view text);

}  // namespace aisle::sim
