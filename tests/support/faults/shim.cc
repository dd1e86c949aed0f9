// Preloaded into the program and all that it starts: makes calls of one kind fail.
//
//   AISLE_FAULT=write:17:28      the 17th write (of all processes together) fails with errno 28
//   AISLE_FAULT=write:0:0        none fails: the calls are counted
//   AISLE_FAULT=readonly:17:30   whatever changes files, from the 17th on, fails with errno 30
//   AISLE_FAULT=clock:17:-3600   from the 17th look at it on, the wall clock is an hour behind
//   AISLE_FAULT_BELOW=DIR     only calls on files below this folder count; mmap and fork always do
//   AISLE_FAULT_COUNT=FILE    eight bytes, 0 in the beginning: where they count together
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/time.h>
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

bool IsBelow(int fd) {
  char link[64], path[4096];
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
  const ssize_t length = ::readlink(link, path, sizeof path - 1);
  if (length <= 0) return false;
  path[length] = '\0';
  return IsBelow(path);
}

/// Counts a call; true where it is the one that fails.
bool Fails(const char* kind) {
  const Plan& plan = ThePlan();
  if (plan.count == nullptr || std::strcmp(kind, plan.kind) != 0) return false;
  if (plan.count->fetch_add(1) + 1 != plan.at) return false;
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

}  // namespace

extern "C" {

ssize_t write(int fd, const void* bytes, std::size_t count) {
  if (IsOurs("write") && IsBelow(fd) && Fails("write")) return -1;
  static const auto real = Real<ssize_t (*)(int, const void*, std::size_t)>("write");
  return real(fd, bytes, count);
}

int fsync(int fd) {
  if (IsOurs("fsync") && IsBelow(fd) && Fails("fsync")) return -1;
  static const auto real = Real<int (*)(int)>("fsync");
  return real(fd);
}

int rename(const char* from, const char* to) noexcept {
  if (IsOurs("rename") && IsBelow(to) && Fails("rename")) return -1;
  if (IsOurs("readonly") && IsBelow(to) && FailsFromThen("readonly")) return -1;
  static const auto real = Real<int (*)(const char*, const char*)>("rename");
  return real(from, to);
}

int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = va_arg(more, mode_t);
  va_end(more);
  if (IsOurs("open") && IsBelow(path) && Fails("open")) return -1;
  const bool changes = (flags & (O_WRONLY | O_RDWR | O_CREAT | O_TRUNC)) != 0;
  if (changes && IsOurs("readonly") && IsBelow(path) && FailsFromThen("readonly")) return -1;
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

void* mmap(void* at, std::size_t size, int protection, int flags, int fd, off_t offset) noexcept {
  if (IsOurs("mmap") && Fails("mmap")) return MAP_FAILED;
  static const auto real = Real<void* (*)(void*, std::size_t, int, int, int, off_t)>("mmap");
  return real(at, size, protection, flags, fd, offset);
}

int mkdir(const char* path, mode_t mode) noexcept {
  if (IsOurs("readonly") && IsBelow(path) && FailsFromThen("readonly")) return -1;
  static const auto real = Real<int (*)(const char*, mode_t)>("mkdir");
  return real(path, mode);
}

int unlink(const char* path) noexcept {
  if (IsOurs("readonly") && IsBelow(path) && FailsFromThen("readonly")) return -1;
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
  if (IsOurs("fork") && Fails("fork")) return -1;
  static const auto real = Real<pid_t (*)()>("fork");
  return real();
}

}  // extern "C"
