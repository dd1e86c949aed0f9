#include "simulator/mesh/confined_files.h"

#include <fstream>
#include <string_view>

namespace aisle::sim {
namespace fs = std::filesystem;

bool IsInside(const fs::path& file, const fs::path& root) {
  std::error_code failed;
  const fs::path real_file = fs::canonical(file, failed);
  if (failed) return false;
  const fs::path real_root = fs::canonical(root, failed);
  if (failed) return false;
  const auto [end, unused] =
      std::mismatch(real_root.begin(), real_root.end(), real_file.begin(), real_file.end());
  return end == real_root.end();
}

std::vector<std::uint8_t> ReadBytes(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

bool ConfinedFiles::Allows(const fs::path& file) const {
  std::error_code failed;
  return fs::is_regular_file(file, failed) && IsInside(file, root_) &&
         fs::file_size(file, failed) <= max_bytes_ && !failed;
}

bool ConfinedFiles::Exists(const char* file) const { return Allows(file); }

Assimp::IOStream* ConfinedFiles::Open(const char* file, const char* mode) {
  const bool writes = std::string_view(mode).find_first_of("wa+") != std::string_view::npos;
  if (writes || !Allows(file)) return nullptr;
  return DefaultIOSystem::Open(file, mode);
}

}  // namespace aisle::sim
