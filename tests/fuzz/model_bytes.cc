#include "simulator/mesh/door/model_bytes.h"

#include <xxhash.h>

#include <cstring>

#include "tests/fuzz/fuzz.h"

namespace {

void Decode(std::string_view bytes) {
  using namespace aisle;
  try {
    const sim::Model model = sim::DecodeModel(bytes, {});
    fuzz::Hold(sim::EncodeModel(model) == bytes, "a model's bytes are those it is written with");
    ++fuzz::taken;
  } catch (const sim::ImportError&) {
  }
}

}  // namespace

/// What a reader that was taken over may send: the bytes as they are, and with a good checksum.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kHeader = 32, kSizeAt = 16, kChecksumAt = 24;
  static const std::string beginning = aisle::sim::EncodeModel({}).substr(0, kSizeAt);
  const std::string_view bytes = aisle::fuzz::Text(data, size);
  Decode(bytes);
  if (size < kHeader) return 0;
  std::string sealed(bytes);
  const std::uint64_t rest = size - kHeader;
  const std::uint64_t checksum = XXH3_64bits(sealed.data() + kHeader, rest);
  sealed.replace(0, kSizeAt, beginning);
  std::memcpy(sealed.data() + kSizeAt, &rest, sizeof(rest));
  std::memcpy(sealed.data() + kChecksumAt, &checksum, sizeof(checksum));
  Decode(sealed);
  return 0;
}
