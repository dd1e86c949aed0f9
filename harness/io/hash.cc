#include "harness/io/hash.h"

#include <xxhash.h>

#include "harness/io/file.h"

namespace aisle {

namespace fs = std::filesystem;

std::uint64_t Hash(std::string_view bytes, std::uint64_t seed) {
  return XXH3_64bits_withSeed(bytes.data(), bytes.size(), seed);
}

std::uint64_t HashFile(const fs::path& path, std::uint64_t seed) {
  return Hash(ReadFile(path), seed);
}

std::uint64_t HashFolder(const fs::path& folder, std::uint64_t seed) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) return seed;
  std::set<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.insert(entry.path());
  }
  for (const fs::path& file : files) {
    seed = Hash(file.lexically_relative(folder).string(), seed);
    seed = HashFile(file, seed);
  }
  return seed;
}

}  // namespace aisle
