#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

namespace aisle::mcap {

// The records of MCAP, version 0: a byte that says which, eight that say how long, a body. Little
// endian throughout, as x86 is; texts and byte strings have a length of four bytes, maps and arrays
// one that counts bytes, not entries. https://mcap.dev/spec

inline constexpr std::string_view kMagic("\x89MCAP0\r\n", 8);
inline constexpr std::size_t kHeadBytes = 9;  ///< of a record, before its body

enum class Op : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kAttachment = 0x09,
  kAttachmentIndex = 0x0A,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

template <class T>
void Put(T value, std::string* to) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  to->append(raw, sizeof value);
}
inline void PutText(std::string_view text, std::string* to) {
  Put(static_cast<std::uint32_t>(text.size()), to);
  to->append(text);
}
inline void PutMap(const std::map<std::string, std::string>& map, std::string* to) {
  std::string body;
  for (const auto& [key, value] : map) {
    PutText(key, &body);
    PutText(value, &body);
  }
  PutText(body, to);
}
/// The record's head and body.
inline void PutRecord(Op op, std::string_view body, std::string* to) {
  Put(op, to);
  Put(static_cast<std::uint64_t>(body.size()), to);
  to->append(body);
}

/// Walks through a body. Throws std::out_of_range where it ends too soon.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : left_(bytes) {}

  template <class T>
  T Get() {
    T value;
    std::memcpy(&value, Take(sizeof value).data(), sizeof value);
    return value;
  }
  std::string_view Text() { return Take(Get<std::uint32_t>()); }
  std::map<std::string, std::string> Map() {
    Fields entries(Text());
    std::map<std::string, std::string> map;
    while (!entries.left_.empty()) {
      const std::string key(entries.Text());
      map[key] = entries.Text();
    }
    return map;
  }
  std::string_view Take(std::uint64_t count) {
    if (count > left_.size()) throw std::out_of_range("a record ends too soon");
    const std::string_view taken = left_.substr(0, count);
    left_.remove_prefix(count);
    return taken;
  }
  std::string_view rest() const { return left_; }

 private:
  std::string_view left_;
};

}  // namespace aisle::mcap
