#include "harness/io/png_palette.h"

#include <string_view>

#include "harness/io/big_endian.h"
#include "harness/io/crc32.h"

namespace aisle {
namespace {

constexpr std::size_t kSignatureBytes = 8, kChunkHeadBytes = 8, kCrcBytes = 4;
constexpr std::size_t kDepthAt = 24, kColourTypeAt = 25;  // in IHDR, which comes first
constexpr std::size_t kHeaderBytes = 33;
constexpr char kIndexed = 3;

std::string InBigEndian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
  return bytes;
}

std::string PaletteOfGreys(std::size_t entries) {
  std::string chunk = "PLTE";
  for (std::size_t i = 0; i < entries; ++i) chunk.append(3, static_cast<char>(i));
  return InBigEndian(static_cast<std::uint32_t>(3 * entries)) + chunk + InBigEndian(Crc32(chunk));
}

}  // namespace

std::optional<std::string> WithIndicesForColours(const std::string& png, std::size_t* entries) {
  if (png.size() < kHeaderBytes || png[kColourTypeAt] != kIndexed) return std::nullopt;
  const int bits = png[kDepthAt];
  if (bits < 1 || bits > 8) return std::nullopt;
  const std::size_t values = std::size_t{1} << bits;
  const std::string_view bytes = png;
  for (std::size_t at = kSignatureBytes; at + kChunkHeadBytes <= bytes.size();) {
    const std::size_t length = BigEndian(bytes.substr(at, 4));
    const std::size_t whole = kChunkHeadBytes + length + kCrcBytes;
    if (whole > bytes.size() - at) return std::nullopt;
    if (bytes.substr(at + 4, 4) != "PLTE") {
      at += whole;
      continue;
    }
    *entries = length / 3;
    if (*entries >= values) return std::nullopt;
    return png.substr(0, at) + PaletteOfGreys(values) + png.substr(at + whole);
  }
  return std::nullopt;
}

}  // namespace aisle
