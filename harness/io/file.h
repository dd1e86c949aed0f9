#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <string_view>

namespace aisle {

enum class Durability {
  kSurvivesPowerLoss,    ///< flushed to the disk before it gets its name
  kSurvivesProcessLoss,  ///< for what can be made again: a kill leaves no half file, a power cut
                         ///< may
};

/// Makes the folders above a file, those that are missing. Throws MachineError, and InputError
/// where the path cannot be one of a file: below a file, or too long.
void MakeParentFolder(const std::filesystem::path& path);

/// Writes aside, flushes to the disk, then renames: under the final name stands either the old file
/// or the whole new one, whenever the power goes. Of a link, the file it leads to. A device or a
/// pipe is written to as it stands. Makes missing folders. Throws MachineError, and InputError
/// where the path cannot be one of a file: below a file, or too long.
void WriteFileAtomically(const std::filesystem::path& path, std::string_view bytes,
                         Durability durability = Durability::kSurvivesPowerLoss);

/// A file that grows aside and gets its name when it is whole: for what is too large to be held at
/// once. Without Commit nothing is left of it, but for what has gone into a device or a pipe. Not
/// thread-safe.
class FileAside {
 public:
  /// Makes missing folders. Throws as WriteFileAtomically does.
  explicit FileAside(const std::filesystem::path& path);
  ~FileAside();
  FileAside(const FileAside&) = delete;
  FileAside& operator=(const FileAside&) = delete;

  /// Throws MachineError.
  void Append(std::string_view bytes);
  std::uint64_t size() const { return size_; }  ///< bytes so far
  /// Under the final name from now on, whole. Throws MachineError.
  void Commit(Durability durability = Durability::kSurvivesPowerLoss);

 private:
  std::filesystem::path path_, aside_;  ///< the same: written to as it stands
  int fd_ = -1;
  std::uint64_t size_ = 0;
};

/// Deletes what killed writers left aside below a folder. Nobody else may be writing there.
void ClearLeftovers(const std::filesystem::path& folder);

/// All below a folder that are no folders, by path and in order, behind links too; a link to a
/// folder around it is not followed, so circles end, and a folder that may not be entered has
/// nothing below it. Throws InputError where they are a million: a mistake.
std::set<std::filesystem::path> FilesBelow(const std::filesystem::path& folder);

/// The file's bytes in order, a piece at a time, however many they are. Throws InputError when it
/// cannot be read.
void ReadInPieces(const std::filesystem::path& path,
                  const std::function<void(std::string_view)>& take);

/// The whole file. Throws InputError when it cannot be read or is larger than max_bytes, of which
/// it reads no more then, whatever the file claims to be.
std::string ReadFile(const std::filesystem::path& path,
                     std::size_t max_bytes = std::size_t{1} << 30);

/// A file that a program of others left in a folder of its own, by its name there: a regular file
/// of at most max_bytes. Links that lead out of the folder, pipes and devices are not followed nor
/// opened to any effect, and nothing is waited for. Throws InputError, of a folder too that it may
/// not enter: who works there may have closed it.
std::string ReadLeftFile(const std::filesystem::path& folder, const std::string& name,
                         std::size_t max_bytes);

/// Deletes a folder with all in it, however deep it is, and what a program of others forbade to
/// enter too; a link alone, not what it leads to. True where it is gone, or never was.
[[nodiscard]] bool TryToRemoveFolder(const std::filesystem::path& folder);

/// The same where what stays would pass for what comes next. Throws MachineError.
void RemoveFolder(const std::filesystem::path& folder);

}  // namespace aisle
