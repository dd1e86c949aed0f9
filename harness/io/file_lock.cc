#include "harness/io/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "harness/io/file.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

int Open(const fs::path& file) {
  MakeParentFolder(file);
  const int opened = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (opened < 0) {
    throw MachineError(fmt::format("{}: cannot open: {}", file.string(), std::strerror(errno)));
  }
  return opened;
}

/// False where it would have to wait and must not.
bool Take(int file, int how, const fs::path& path) {
  while (::flock(file, how) != 0) {
    if (errno == EWOULDBLOCK) return false;
    if (errno != EINTR) {
      throw MachineError(fmt::format("{}: cannot lock: {}", path.string(), std::strerror(errno)));
    }
  }
  return true;
}

}  // namespace

FileLock::FileLock(const fs::path& file) : file_(Open(file)) { Take(file_, LOCK_EX, file); }

std::optional<FileLock> FileLock::Try(const fs::path& file) {
  FileLock lock;
  lock.file_ = Open(file);
  if (!Take(lock.file_, LOCK_EX | LOCK_NB, file)) return std::nullopt;
  return lock;
}

std::optional<FileLock> FileLock::TryToRead(const fs::path& file) {
  FileLock lock;
  lock.file_ = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (lock.file_ < 0 || ::flock(lock.file_, LOCK_SH | LOCK_NB) == 0) return lock;
  if (errno == EWOULDBLOCK) return std::nullopt;
  return lock;
}

FileLock::FileLock(FileLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}

FileLock::~FileLock() {
  if (file_ >= 0) ::close(file_);
}

}  // namespace aisle
