#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace aisle {

/// 64-bit XXH3; for caches and checksums, not against an adversary.
std::uint64_t Hash(std::string_view bytes, std::uint64_t seed = 0);

/// Of the file's bytes.
std::uint64_t HashFile(const std::filesystem::path& path, std::uint64_t seed = 0);

/// Of the names and bytes of every file below a folder (FilesBelow), in the order of their names;
/// `seed` alone where there is no such folder.
std::uint64_t HashFolder(const std::filesystem::path& folder, std::uint64_t seed = 0);

}  // namespace aisle
