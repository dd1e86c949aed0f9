#include "harness/bag/picture_size.h"

#include "harness/io/big_endian.h"

namespace aisle {
namespace {

using Bytes = std::span<const std::uint8_t>;

/// ITU T.81, B.1.1.3: markers that begin a frame; the others of C0 to CF define tables.
bool IsFrame(std::uint8_t marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

/// TEM and RSTn have no length behind them.
bool StandsAlone(std::uint8_t marker) {
  return marker == 0x01 || (marker >= 0xD0 && marker <= 0xD7);
}

/// Segment after segment, up to the frame's: a thumbnail's frame lies within a segment.
PictureSize SizeOfJpeg(Bytes bytes) {
  if (bytes.size() < 2 || bytes[0] != 0xFF || bytes[1] != 0xD8) return {};
  for (std::size_t at = 2; at + 9 <= bytes.size() && bytes[at] == 0xFF;) {
    const std::uint8_t marker = bytes[at + 1];
    if (IsFrame(marker)) {
      return {BigEndian(bytes.subspan(at + 7, 2)), BigEndian(bytes.subspan(at + 5, 2))};
    }
    if (marker == 0xFF) {
      ++at;  // any number of them may stand before a marker
    } else {
      at += 2 + (StandsAlone(marker) ? 0 : BigEndian(bytes.subspan(at + 2, 2)));
    }
  }
  return {};
}

}  // namespace

PictureSize SizeOfPicture(std::span<const std::uint8_t> bytes) {
  const auto png = SizeOfPng({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  return png ? *png : SizeOfJpeg(bytes);
}

}  // namespace aisle
