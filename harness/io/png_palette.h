#pragma once

#include <optional>
#include <string>

namespace aisle {

/// The same PNG with as many greys for its palette as its pixels' bits have values, entry i being
/// (i, i, i): decoded, it is the indices. `entries` becomes the number of those that the palette
/// had. Nothing where the image has no palette, where it has all entries, or where it is damaged.
std::optional<std::string> WithIndicesForColours(const std::string& png, std::size_t* entries);

}  // namespace aisle
