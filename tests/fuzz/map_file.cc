#include "slam/map/map_file.h"

#include <cstring>

#include "tests/fuzz/fuzz.h"

namespace {

/// What every map of today begins with: its magic and its version.
const std::string& Beginning() {
  static const std::string beginning = [] {
    const std::filesystem::path file = aisle::fuzz::AsFile("", "empty.map");
    aisle::slam::SaveMap({}, file);
    std::string bytes(16, '\0');
    std::ifstream(file, std::ios::binary).read(bytes.data(), 16);
    return bytes;
  }();
  return beginning;
}

/// The header that belongs to a body: the checksum keeps accidents out, a fuzzer has to get by it.
std::string Sealed(std::string_view body) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  const auto add = [&hash](std::uint64_t word) {
    hash = (hash ^ word) * 0x100000001b3ULL;
    hash ^= hash >> 29;
  };
  std::size_t i = 0;
  for (; i + 8 <= body.size(); i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, body.data() + i, 8);
    add(word);
  }
  for (; i < body.size(); ++i) add(static_cast<unsigned char>(body[i]));
  std::string sealed = Beginning();
  const std::uint64_t rest[] = {body.size(), hash};
  sealed.append(reinterpret_cast<const char*>(rest), sizeof(rest));
  return sealed.append(body);
}

void Load(std::string_view bytes) {
  using namespace aisle;
  try {
    const slam::SavedMap map = slam::LoadMap(fuzz::AsFile(bytes, "fuzz.map"));
    const std::filesystem::path again = fuzz::AsFile("", "again.map");
    slam::SaveMap(map, again);
    fuzz::Hold(slam::LoadMap(again).reference == map.reference, "a map reads back as written");
    ++fuzz::taken;
  } catch (const std::runtime_error&) {
  }
}

}  // namespace

/// A map file as it is, and the bytes as the body of one with a good checksum.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes = aisle::fuzz::Text(data, size);
  constexpr std::size_t kHeader = 32;
  Load(bytes);
  if (bytes.starts_with("aislemap") && size > kHeader) Load(Sealed(bytes.substr(kHeader)));
  return 0;
}
