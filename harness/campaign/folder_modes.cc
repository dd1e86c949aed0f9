#include "harness/campaign/folder_modes.h"

#include <sys/stat.h>

#include <optional>

namespace aisle {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kModeBits = 07777;

std::optional<struct stat> StatusOf(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return status;
}

/// An absolute path without what it can be said without.
fs::path Plain(const fs::path& path) {
  const fs::path plain = fs::absolute(path).lexically_normal();
  return plain.has_filename() ? plain : plain.parent_path();
}

}  // namespace

void FolderModes::Add(const std::vector<fs::path>& paths) {
  for (const fs::path& path : paths) {
    std::error_code error;
    Remember(Plain(path));
    Remember(fs::weakly_canonical(path, error));  // a link's folders are not those it leads to
  }
}

void FolderModes::Remember(const fs::path& path) {
  fs::path place;
  for (const fs::path& part : path) {
    const auto status = StatusOf(place /= part);
    if (!status) return;
    Mode& kept = modes_[place];
    kept.mode |= status->st_mode & kModeBits;
    // One that not even its owner can enter was taken away already.
    const bool is_closed = S_ISDIR(status->st_mode) && (status->st_mode & S_IXUSR) == 0;
    if (is_closed) kept.mode |= S_IRWXU;
    kept.watched |= place == path ? kModeBits : S_IRWXU;
  }
}

void FolderModes::PutBack() const {
  for (const auto& [path, kept] : modes_) {
    const auto status = StatusOf(path);
    if (!status || (kept.mode & ~status->st_mode & kept.watched) == 0) continue;
    ::chmod(path.c_str(), kept.mode | (status->st_mode & kModeBits));
  }
}

}  // namespace aisle
