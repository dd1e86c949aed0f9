#pragma once

#include <filesystem>
#include <optional>

namespace aisle {

/// Held by one process of all; let go when it ends, however that happens. The file stays.
class FileLock {
 public:
  /// Waits until nobody else holds it. Makes the file and its folder. Throws MachineError,
  /// and InputError where there can be no such folder.
  explicit FileLock(const std::filesystem::path& file);
  /// None where somebody else holds it. Throws likewise.
  static std::optional<FileLock> Try(const std::filesystem::path& file);
  /// Beside others who only read, and who keep Try from it as long; none where somebody holds it.
  /// Makes nothing: a file that is not there, or that cannot be opened or locked here, nobody is
  /// known to hold.
  static std::optional<FileLock> TryToRead(const std::filesystem::path& file);

  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&&) = delete;
  ~FileLock();

 private:
  FileLock() = default;
  int file_ = -1;
};

}  // namespace aisle
