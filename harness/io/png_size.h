#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace aisle {

/// In pixels.
struct PictureSize {
  std::uint32_t width = 0, height = 0;
};

/// Size that the header of a PNG states; nothing is decoded. Nothing where the bytes do not open
/// with the signature and the chunk IHDR, or end before they say it.
std::optional<PictureSize> SizeOfPng(std::string_view bytes);

}  // namespace aisle
