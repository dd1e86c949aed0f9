#include "harness/io/hash.h"

#include <xxhash.h>

#include <memory>
#include <new>

#include "harness/io/file.h"

namespace aisle {

namespace fs = std::filesystem;

std::uint64_t Hash(std::string_view bytes, std::uint64_t seed) {
  return XXH3_64bits_withSeed(bytes.data(), bytes.size(), seed);
}

std::uint64_t HashFile(const fs::path& path, std::uint64_t seed) {
  std::error_code error;  // what is no file may have no end: it is read as far as files may go
  if (!fs::is_regular_file(path, error)) return Hash(ReadFile(path), seed);
  // A system's weights may be larger than memory should hold.
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(),
                                                                       XXH3_freeState);
  if (!state) throw std::bad_alloc();
  XXH3_64bits_reset_withSeed(state.get(), seed);
  ReadInPieces(path, [&](std::string_view piece) {
    XXH3_64bits_update(state.get(), piece.data(), piece.size());
  });
  return XXH3_64bits_digest(state.get());
}

std::uint64_t HashFolder(const fs::path& folder, std::uint64_t seed) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) return seed;
  for (const fs::path& file : FilesBelow(folder)) {
    if (!fs::is_regular_file(file, error)) continue;
    seed = Hash(file.lexically_relative(folder).string(), seed);
    seed = HashFile(file, seed);
  }
  return seed;
}

}  // namespace aisle
