#pragma once

#include <cstdint>
#include <string_view>

namespace aisle {

/// CRC-32 of ISO 3309, reflected, as ZIP, PNG and MCAP have it. `crc` is that of the bytes before
/// these, for bytes that come in parts; 0 at the beginning.
std::uint32_t Crc32(std::string_view bytes, std::uint32_t crc = 0);

}  // namespace aisle
