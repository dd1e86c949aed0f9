#include "harness/campaign/own_memory.h"

#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <charconv>
#include <string_view>

#include "harness/campaign/landlock.h"

namespace aisle {
namespace {

constexpr const char* kSharedMemory = "/dev/shm";

bool Write(const char* path, std::string_view text) {
  const int file = ::open(path, O_WRONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool whole = ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  ::close(file);
  return whole;
}

/// "1000 1000 1": within as without.
bool MapToItself(const char* path, unsigned id) {
  char text[40];
  char* end = text;
  for (int side = 0; side < 2; ++side) {
    end = std::to_chars(end, text + sizeof text, id).ptr;
    *end++ = ' ';
  }
  *end++ = '1';
  return Write(path, {text, static_cast<std::size_t>(end - text)});
}

/// Mounts of our own: of a system administrator at once, of others in a user namespace.
bool EnterOwnMounts() {
  const uid_t user = ::geteuid();
  const gid_t group = ::getegid();
  if (user == 0) return ::unshare(CLONE_NEWNS) == 0;
  return ::unshare(CLONE_NEWUSER | CLONE_NEWNS) == 0 && Write("/proc/self/setgroups", "deny") &&
         MapToItself("/proc/self/uid_map", user) && MapToItself("/proc/self/gid_map", group);
}

}  // namespace

bool TakeOwnSharedMemory(const SharedMemoryRule& rule) {
  if (!EnterOwnMounts()) return false;
  // What the machine mounts later appears here too; what is mounted here does not appear there.
  if (::mount(nullptr, "/", nullptr, MS_REC | MS_SLAVE, nullptr) != 0) return false;
  if (::mount("tmpfs", kSharedMemory, "tmpfs", MS_NOSUID | MS_NODEV, "mode=1777") != 0)
    return false;
  if (rule.ruleset < 0) return true;
  const int folder = ::open(kSharedMemory, O_PATH | O_CLOEXEC);
  const bool allowed = folder >= 0 && AddPathRule(rule.ruleset, folder, rule.access);
  ::close(folder);
  return allowed;
}

bool CanOwnSharedMemory() {
  static const bool can = [] {
    const pid_t child = ::fork();
    if (child == 0) ::_exit(TakeOwnSharedMemory({}) ? 0 : 1);
    int status = 1;
    return child > 0 && ::waitpid(child, &status, 0) == child && WIFEXITED(status) &&
           WEXITSTATUS(status) == 0;
  }();
  return can;
}

}  // namespace aisle
