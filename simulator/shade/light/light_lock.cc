#include "simulator/shade/light/light_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

namespace aisle::sim {
namespace {

/// Whether the file that is open is the one that others find there: its last holder may have taken
/// it away between our opening and locking it.
bool IsStillThere(int fd, const std::filesystem::path& file) {
  struct stat ours {
  }, there{};
  return fstat(fd, &ours) == 0 && stat(file.c_str(), &there) == 0 && ours.st_ino == there.st_ino &&
         ours.st_dev == there.st_dev;
}

}  // namespace

std::optional<LightLock> LightLock::Try(const std::filesystem::path& file) {
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  LightLock lock;
  lock.file_ = file;
  for (;;) {
    const int fd = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (fd < 0) return lock;
    if (flock(fd, LOCK_EX | LOCK_NB) != 0) {
      const bool is_held = errno == EWOULDBLOCK;
      close(fd);
      if (is_held) return std::nullopt;
      return lock;  // a file system without locks
    }
    if (IsStillThere(fd, file)) {
      lock.fd_ = fd;
      return lock;
    }
    close(fd);
  }
}

LightLock::LightLock(LightLock&& other) noexcept
    : file_(std::move(other.file_)), fd_(std::exchange(other.fd_, -1)) {}

LightLock::~LightLock() {
  if (fd_ < 0) return;
  if (IsStillThere(fd_, file_)) unlink(file_.c_str());
  close(fd_);
}

void LightLock::Beat(double share) const {
  if (fd_ < 0) return;
  LightWait::Beat beat;
  if (pread(fd_, &beat, sizeof(beat), 0) != sizeof(beat)) beat = {};
  beat = {share, beat.count + 1};
  // One that does not arrive is as one that was not sent.
  [[maybe_unused]] const ssize_t written = pwrite(fd_, &beat, sizeof(beat), 0);
}

bool LightWait::Look(Clock::time_point now, Clock::duration patience) {
  Beat beat;
  std::ifstream in(file_, std::ios::binary);
  in.read(reinterpret_cast<char*>(&beat), sizeof(beat));
  if (!in) beat = beat_;  // not written yet, or taken away just now
  if (!heard_ || beat != beat_) {
    beat_ = beat;
    heard_ = now;
  }
  return now - *heard_ < patience;
}

}  // namespace aisle::sim
