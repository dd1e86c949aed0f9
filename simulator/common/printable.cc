#include "simulator/common/printable.h"

#include <fmt/format.h>

#include <algorithm>

namespace aisle::sim {
namespace {

/// Whether a character of several bytes goes on here.
bool GoesOn(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

}  // namespace

std::string Printable(std::string_view text, std::size_t most_bytes) {
  std::size_t length = std::min(text.size(), most_bytes);
  while (length > 0 && length < text.size() && GoesOn(text[length])) --length;
  std::string printable;
  for (std::size_t i = 0; i < length; ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    // U+0080 to U+009F are control characters, too: c2 9b begins what ESC [ does.
    const bool is_c1 = byte == 0xc2 && i + 1 < length && GoesOn(text[i + 1]) &&
                       static_cast<unsigned char>(text[i + 1]) < 0xa0;
    if (is_c1) {
      printable += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[++i]));
    } else if (byte < 0x20 || byte == 0x7f) {
      printable += fmt::format("\\x{:02x}", byte);
    } else {
      printable += text[i];
    }
  }
  return length < text.size() ? printable + "…" : printable;
}

}  // namespace aisle::sim
