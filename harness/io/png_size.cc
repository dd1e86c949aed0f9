#include "harness/io/png_size.h"

#include "harness/io/big_endian.h"

namespace aisle {

std::optional<PictureSize> SizeOfPng(std::string_view bytes) {
  // The signature, and the chunk IHDR of 13 bytes, which must be the first.
  constexpr std::string_view kBeginning("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);
  if (bytes.size() < kBeginning.size() + 8 || !bytes.starts_with(kBeginning)) return std::nullopt;
  return PictureSize{BigEndian(bytes.substr(16, 4)), BigEndian(bytes.substr(20, 4))};
}

}  // namespace aisle
