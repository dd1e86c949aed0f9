#pragma once

#include <string>
#include <string_view>

namespace aisle::sim {

/// A user's text for a message: control characters, which a terminal would obey, as \x1b, and no
/// more than `most_bytes` of it.
std::string Printable(std::string_view text, std::size_t most_bytes = 60);

}  // namespace aisle::sim
