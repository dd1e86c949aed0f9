// Preloaded into the program and all that it starts: makes calls of one kind fail.
//
//   AISLE_FAULT=write:17:28      the 17th write (of all processes together) fails with errno 28
//   AISLE_FAULT=write:0:0        none fails: the calls are counted
//   AISLE_FAULT=readonly:17:30   whatever changes files, from the 17th on, fails with errno 30
//   AISLE_FAULT=clock:17:-3600   from the 17th look at it on, the wall clock is an hour behind
//   AISLE_FAULT_BELOW=DIR     only calls on files below this folder count; mmap and fork always do
//   AISLE_FAULT_COUNT=FILE    eight bytes, 0 in the beginning: where they count together. FILE.hit
//                             says which call failed, if one did
//
// A kind is all calls that come to the same: write is pwrite, writev and what stdio flushes
// besides; fsync fdatasync; open openat, opendir and fopen; fork posix_spawn and popen.
#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/uio.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

struct Plan {
  char kind[16] = {};
  unsigned long at = 0;
  int error = 0;
  const char* below = nullptr;
  std::atomic<std::uint64_t>* count = nullptr;
};

template <class Function>
Function Real(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

Plan ReadPlan() {
  Plan plan;
  const char* fault = std::getenv("AISLE_FAULT");
  const char* file = std::getenv("AISLE_FAULT_COUNT");
  plan.below = std::getenv("AISLE_FAULT_BELOW");
  if (fault == nullptr || file == nullptr) return plan;
  std::sscanf(fault, "%15[a-z]:%lu:%d", plan.kind, &plan.at, &plan.error);
  const int fd = Real<int (*)(const char*, int, ...)>("open")(file, O_RDWR | O_CLOEXEC);
  if (fd < 0) return plan;
  void* shared = Real<void* (*)(void*, std::size_t, int, int, int, off_t)>("mmap")(
      nullptr, sizeof(std::uint64_t), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
  Real<int (*)(int)>("close")(fd);
  if (shared != MAP_FAILED) plan.count = static_cast<std::atomic<std::uint64_t>*>(shared);
  return plan;
}

const Plan& ThePlan() {
  static const Plan plan = ReadPlan();
  return plan;
}

bool IsBelow(const char* path) {
  const char* below = ThePlan().below;
  return below == nullptr ||
         (path != nullptr && std::strncmp(path, below, std::strlen(below)) == 0);
}

using Path = char[8192];

/// Where an open file lies; empty where nobody can say.
const char* PathOf(int fd, Path& path) {
  char link[64];
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
  const ssize_t length = ::readlink(link, path, sizeof path / 2);
  path[length < 0 ? 0 : length] = '\0';
  return path;
}

/// Leaves a line beside the count, past the calls that are replaced here.
void TellHit(const char* what) {
  char path[4096], line[4600];
  std::snprintf(path, sizeof path, "%s.hit", std::getenv("AISLE_FAULT_COUNT"));
  const int length =
      std::snprintf(line, sizeof line, "%s: %s\n", ::program_invocation_short_name, what);
  const long file = ::syscall(SYS_open, path, O_WRONLY | O_CREAT | O_APPEND, 0644);
  ::syscall(SYS_write, file, line, static_cast<std::size_t>(length));
  ::syscall(SYS_close, file);
}

/// Counts a call on `what`; true where it is the one that fails.
bool Fails(const char* kind, const char* what) {
  const Plan& plan = ThePlan();
  if (plan.count == nullptr || std::strcmp(kind, plan.kind) != 0) return false;
  if (plan.count->fetch_add(1) + 1 != plan.at) return false;
  TellHit(what);
  errno = plan.error;
  return true;
}

/// The same, for all calls from that one on.
bool FailsFromThen(const char* kind) {
  const Plan& plan = ThePlan();
  if (plan.count == nullptr || std::strcmp(kind, plan.kind) != 0) return false;
  if (plan.count->fetch_add(1) + 1 < plan.at || plan.at == 0) return false;
  errno = plan.error;
  return true;
}

bool IsOurs(const char* kind) { return std::strcmp(kind, ThePlan().kind) == 0; }

bool FailsOn(const char* kind, const char* path) {
  return IsOurs(kind) && IsBelow(path) && Fails(kind, path);
}
bool FailsOn(const char* kind, int fd) {
  if (!IsOurs(kind)) return false;
  Path path;
  return FailsOn(kind, PathOf(fd, path));
}
bool ReadonlyFails(const char* path) {
  return IsOurs("readonly") && IsBelow(path) && FailsFromThen("readonly");
}
bool RenameFails(const char* to) { return FailsOn("rename", to) || ReadonlyFails(to); }
bool OpenFails(const char* path, bool changes) {
  return FailsOn("open", path) || (changes && ReadonlyFails(path));
}

/// A path that stands behind a folder's descriptor.
const char* Whole(int folder, const char* path, Path& room) {
  if (folder == AT_FDCWD || path == nullptr || path[0] == '/') return path;
  const std::size_t length = std::strlen(PathOf(folder, room));
  std::snprintf(room + length, sizeof room - length, "/%s", path);
  return room;
}

bool Changes(int flags) { return (flags & (O_WRONLY | O_RDWR | O_CREAT | O_TRUNC)) != 0; }

}  // namespace

extern "C" {

ssize_t write(int fd, const void* bytes, std::size_t count) {
  if (FailsOn("write", fd)) return -1;
  static const auto real = Real<ssize_t (*)(int, const void*, std::size_t)>("write");
  return real(fd, bytes, count);
}

ssize_t writev(int fd, const iovec* pieces, int count) {
  if (FailsOn("write", fd)) return -1;
  static const auto real = Real<ssize_t (*)(int, const iovec*, int)>("writev");
  return real(fd, pieces, count);
}

ssize_t pwrite64(int fd, const void* bytes, std::size_t count, off64_t at) {
  if (FailsOn("write", fd)) return -1;
  static const auto real = Real<ssize_t (*)(int, const void*, std::size_t, off64_t)>("pwrite64");
  return real(fd, bytes, count, at);
}

ssize_t pwrite(int fd, const void* bytes, std::size_t count, off_t at) {
  return pwrite64(fd, bytes, count, at);
}

int fsync(int fd) {
  if (FailsOn("fsync", fd)) return -1;
  static const auto real = Real<int (*)(int)>("fsync");
  return real(fd);
}

int fdatasync(int fd) {
  if (FailsOn("fsync", fd)) return -1;
  static const auto real = Real<int (*)(int)>("fdatasync");
  return real(fd);
}

int rename(const char* from, const char* to) noexcept {
  if (RenameFails(to)) return -1;
  static const auto real = Real<int (*)(const char*, const char*)>("rename");
  return real(from, to);
}

int renameat(int from_folder, const char* from, int to_folder, const char* to) noexcept {
  Path room;
  if (RenameFails(Whole(to_folder, to, room))) return -1;
  static const auto real = Real<int (*)(int, const char*, int, const char*)>("renameat");
  return real(from_folder, from, to_folder, to);
}

int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = va_arg(more, mode_t);
  va_end(more);
  if (OpenFails(path, Changes(flags))) return -1;
  static const auto real = Real<int (*)(const char*, int, ...)>("open");
  return real(path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = va_arg(more, mode_t);
  va_end(more);
  return open(path, flags | O_LARGEFILE, mode);
}

int openat(int folder, const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = va_arg(more, mode_t);
  va_end(more);
  Path room;
  if (OpenFails(Whole(folder, path, room), Changes(flags))) return -1;
  static const auto real = Real<int (*)(int, const char*, int, ...)>("openat");
  return real(folder, path, flags, mode);
}

int openat64(int folder, const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = va_arg(more, mode_t);
  va_end(more);
  return openat(folder, path, flags | O_LARGEFILE, mode);
}

DIR* opendir(const char* path) {
  if (OpenFails(path, false)) return nullptr;
  static const auto real = Real<DIR* (*)(const char*)>("opendir");
  return real(path);
}

FILE* fopen(const char* path, const char* mode) {
  if (OpenFails(path, std::strpbrk(mode, "wa+") != nullptr)) return nullptr;
  static const auto real = Real<FILE* (*)(const char*, const char*)>("fopen");
  return real(path, mode);
}

FILE* fopen64(const char* path, const char* mode) { return fopen(path, mode); }

void* mmap(void* at, std::size_t size, int protection, int flags, int fd, off_t offset) noexcept {
  if (IsOurs("mmap") && Fails("mmap", "memory")) return MAP_FAILED;
  static const auto real = Real<void* (*)(void*, std::size_t, int, int, int, off_t)>("mmap");
  return real(at, size, protection, flags, fd, offset);
}

void* mmap64(void* at, std::size_t size, int protection, int flags, int fd,
             off64_t offset) noexcept {
  return mmap(at, size, protection, flags, fd, offset);
}

int mkdir(const char* path, mode_t mode) noexcept {
  if (ReadonlyFails(path)) return -1;
  static const auto real = Real<int (*)(const char*, mode_t)>("mkdir");
  return real(path, mode);
}

int unlink(const char* path) noexcept {
  if (ReadonlyFails(path)) return -1;
  static const auto real = Real<int (*)(const char*)>("unlink");
  return real(path);
}

/// The wall clock alone: no setting of it moves the monotonic one.
int clock_gettime(clockid_t clock, timespec* now) noexcept {
  static const auto real = Real<int (*)(clockid_t, timespec*)>("clock_gettime");
  const int result = real(clock, now);
  if (clock == CLOCK_REALTIME && IsOurs("clock") && FailsFromThen("clock")) {
    now->tv_sec += ThePlan().error;
  }
  return result;
}

time_t time(time_t* seconds) noexcept {
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  if (seconds != nullptr) *seconds = now.tv_sec;
  return now.tv_sec;
}

pid_t fork() noexcept {
  if (IsOurs("fork") && Fails("fork", "fork")) return -1;
  static const auto real = Real<pid_t (*)()>("fork");
  return real();
}

int posix_spawn(pid_t* pid, const char* path, const posix_spawn_file_actions_t* files,
                const posix_spawnattr_t* attributes, char* const* argv, char* const* environment) {
  if (IsOurs("fork") && Fails("fork", path)) return errno;
  static const auto real =
      Real<int (*)(pid_t*, const char*, const posix_spawn_file_actions_t*, const posix_spawnattr_t*,
                   char* const*, char* const*)>("posix_spawn");
  return real(pid, path, files, attributes, argv, environment);
}

FILE* popen(const char* command, const char* mode) {
  if (IsOurs("fork") && Fails("fork", command)) return nullptr;
  static const auto real = Real<FILE* (*)(const char*, const char*)>("popen");
  return real(command, mode);
}

}  // extern "C"
