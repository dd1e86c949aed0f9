#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace aisle::sim {

/// Why a user's file is not to be opened, "file: why", or "": it is absent, no regular file (a
/// device may have no end) or larger than `most_bytes`.
std::string InputFileError(const std::filesystem::path& file, std::uintmax_t most_bytes);

}  // namespace aisle::sim
