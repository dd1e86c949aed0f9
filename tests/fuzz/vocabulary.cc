#include "slam/place/vocabulary.h"

#include <cstring>

#include "tests/fuzz/fuzz.h"

namespace {

constexpr std::size_t kHeader = 24, kNodesAt = 12, kChecksumAt = 16, kNode = 48;

/// With the number of nodes and the checksum that its nodes have.
std::string Sealed(std::string_view bytes) {
  std::string sealed(bytes);
  const auto nodes = static_cast<std::uint32_t>((bytes.size() - kHeader) / kNode);
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (std::size_t i = kHeader; i < kHeader + nodes * kNode; ++i) {
    hash = (hash ^ static_cast<unsigned char>(bytes[i])) * 0x100000001b3ULL;
  }
  std::memcpy(sealed.data() + kNodesAt, &nodes, sizeof(nodes));
  std::memcpy(sealed.data() + kChecksumAt, &hash, sizeof(hash));
  return sealed;
}

void Load(std::string_view bytes) {
  using namespace aisle;
  try {
    const auto vocabulary = slam::Vocabulary::Load(fuzz::AsFile(bytes, "fuzz.voc"));
    fuzz::Hold(vocabulary.words() > 0, "a vocabulary that is read has words");
    vocabulary.Describe({{1, 2, 3, 4}, {~0ull, 0, ~0ull, 0}, {}});
    ++fuzz::taken;
  } catch (const std::runtime_error&) {
  }
}

}  // namespace

/// A vocabulary as it is, and with its checksum made right; what is read is asked for words.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes = aisle::fuzz::Text(data, size);
  Load(bytes);
  if (size >= kHeader + kNode) Load(Sealed(bytes));
  return 0;
}
