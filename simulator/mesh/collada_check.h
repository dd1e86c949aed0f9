#pragma once

#include <string_view>

namespace aisle::sim {

/// Holds a COLLADA file's numbers against each other before the parser sees it, which believes what
/// it reads: arrays as long as they say and finite, accessors inside their arrays, faces and
/// weights of things that exist, nodes that do not contain themselves. Throws ImportError with the
/// line.
void CheckCollada(std::string_view text);

}  // namespace aisle::sim
