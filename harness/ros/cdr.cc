#include "harness/ros/cdr.h"

namespace aisle::ros {

CdrReader::CdrReader(std::string_view bytes) {
  if (bytes.size() < kEncapsulation) throw CdrError("is shorter than its encapsulation");
  const auto kind = static_cast<unsigned char>(bytes[1]);
  if (bytes[0] != 0 || kind > 1) {
    throw CdrError(fmt::format("is encapsulated as {:02x} {:02x}: plain CDR is 00 00 or 00 01",
                               static_cast<unsigned char>(bytes[0]), kind));
  }
  swap_ = kind == 0;
  bytes_ = bytes.substr(kEncapsulation);
}

void CdrReader::ExpectEnd() const {
  constexpr std::size_t kPadding = 3;  // some writers fill the last word
  if (bytes_.size() - at_ > kPadding) {
    throw CdrError(fmt::format("has {} bytes more than its type", bytes_.size() - at_));
  }
}

std::string_view CdrReader::Take(std::size_t count) {
  if (count > bytes_.size() - at_) throw CdrError("ends before its type does");
  const std::string_view taken = bytes_.substr(at_, count);
  at_ += count;
  return taken;
}

void CdrReader::Align(std::size_t size) {
  const std::size_t past = at_ % size;
  if (past != 0) Take(size - past);
}

void CdrReader::Get(std::string* text) {
  std::uint32_t length = 0;
  Get(&length);
  const std::string_view raw = Take(length);
  if (length == 0) {  // some writers leave the zero of an empty text out
    text->clear();
    return;
  }
  if (raw.back() != '\0') throw CdrError("has a string without its terminator");
  *text = raw.substr(0, length - 1);
}

}  // namespace aisle::ros
