#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace aisle {

enum class Durability {
  kSurvivesPowerLoss,    ///< flushed to the disk before it gets its name
  kSurvivesProcessLoss,  ///< for what can be made again: a kill leaves no half file, a power cut
                         ///< may
};

/// Writes aside, flushes to the disk, then renames: under the final name stands either the old file
/// or the whole new one, whenever the power goes. Makes missing folders. Throws MachineError.
void WriteFileAtomically(const std::filesystem::path& path, std::string_view bytes,
                         Durability durability = Durability::kSurvivesPowerLoss);

/// Deletes what killed writers left aside below a folder. Nobody else may be writing there.
void ClearLeftovers(const std::filesystem::path& folder);

/// The whole file. Throws InputError when it cannot be read or is larger than max_bytes.
std::string ReadFile(const std::filesystem::path& path,
                     std::size_t max_bytes = std::size_t{1} << 30);

}  // namespace aisle
