#pragma once

#include <cstdint>
#include <span>

#include "harness/io/png_size.h"

namespace aisle {

/// Size in pixels as the header of a PNG or JPEG states it; nothing is decoded. 0 x 0 where the
/// bytes are neither, or end before they say it.
PictureSize SizeOfPicture(std::span<const std::uint8_t> bytes);

}  // namespace aisle
