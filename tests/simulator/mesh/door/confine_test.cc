#include "simulator/mesh/door/confine.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>

#include "tests/simulator/mesh/scratch.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

/// What a confined process is able to do, found out in one that ends with it.
bool Can(const fs::path& folder, const std::function<bool()>& attempt) {
  const pid_t pid = ::fork();
  if (pid == 0) {
    try {
      ConfineThisProcess(folder, {});
      ::_exit(attempt() ? 1 : 0);
    } catch (...) {
      ::_exit(2);
    }
  }
  int status = 0;
  ::waitpid(pid, &status, 0);
  EXPECT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
  EXPECT_NE(WEXITSTATUS(status), 2) << "it could not be confined";
  return WEXITSTATUS(status) == 1;
}

bool CanOpen(const fs::path& file, int flags) { return ::open(file.c_str(), flags, 0600) >= 0; }

bool KernelHasLandlock() { return ::access("/sys/kernel/security/landlock", F_OK) == 0; }

TEST(Confined, ReadsItsFolderAndNothingElse) {
  const Scratch scratch;
  const fs::path own = scratch.Write("own", "x");
  EXPECT_TRUE(Can(scratch.path(), [&] { return CanOpen(own, O_RDONLY); }));
  const bool reads_others = Can(scratch.path(), [] { return CanOpen("/etc/passwd", O_RDONLY); });
  if (reads_others && !KernelHasLandlock()) GTEST_SKIP() << "this kernel has no Landlock";
  EXPECT_FALSE(reads_others);
  EXPECT_FALSE(Can(scratch.path(), [&] { return CanOpen(own, O_WRONLY); }));
  EXPECT_FALSE(
      Can(scratch.path(), [&] { return CanOpen(scratch.path() / "new", O_WRONLY | O_CREAT); }));
  EXPECT_FALSE(Can(scratch.path(), [&] { return ::unlink(own.c_str()) == 0; }));
}

TEST(Confined, StartsNothingAndTalksToNobody) {
  const Scratch scratch;
  EXPECT_FALSE(Can(scratch.path(), [] { return ::socket(AF_INET, SOCK_STREAM, 0) >= 0; }));
  EXPECT_FALSE(Can(scratch.path(), [] { return ::socket(AF_UNIX, SOCK_DGRAM, 0) >= 0; }));
  EXPECT_FALSE(Can(scratch.path(), [] { return ::fork() >= 0; }));
  EXPECT_FALSE(Can(scratch.path(), [] {
    char* const none[] = {nullptr};
    return ::execve("/bin/true", none, none) != -1 || errno != EPERM;
  }));
  const pid_t parent = ::getpid();
  EXPECT_FALSE(Can(scratch.path(), [=] { return ::kill(parent, 0) == 0; }));
}

TEST(Confined, SignalsItselfAlone) {
  const Scratch scratch;
  const pid_t parent = ::getpid();
  siginfo_t info{};
  info.si_code = SI_QUEUE;
  EXPECT_FALSE(Can(scratch.path(), [=] { return ::syscall(SYS_tgkill, parent, parent, 0) == 0; }));
  EXPECT_FALSE(Can(scratch.path(), [=] { return ::syscall(SYS_tkill, parent, 0) == 0; }));
  EXPECT_FALSE(
      Can(scratch.path(), [&] { return ::syscall(SYS_rt_sigqueueinfo, parent, 0, &info) == 0; }));
  EXPECT_FALSE(Can(scratch.path(), [&] {
    return ::syscall(SYS_rt_tgsigqueueinfo, parent, parent, 0, &info) == 0;
  }));
  const int handle = static_cast<int>(::syscall(SYS_pidfd_open, parent, 0));
  if (handle >= 0) {
    EXPECT_FALSE(Can(scratch.path(),
                     [=] { return ::syscall(SYS_pidfd_send_signal, handle, 0, nullptr, 0) == 0; }));
    ::close(handle);
  }
  // As abort() does.
  EXPECT_TRUE(Can(scratch.path(), [] {
    return ::syscall(SYS_tgkill, ::getpid(), static_cast<pid_t>(::syscall(SYS_gettid)), 0) == 0;
  }));
}

TEST(Confined, SpendsNoMoreThanItsLimits) {
  const Scratch scratch;
  EXPECT_FALSE(Can(scratch.path(), [] {
    rlimit files{}, size{}, cpu{};
    ::getrlimit(RLIMIT_NOFILE, &files);
    ::getrlimit(RLIMIT_FSIZE, &size);
    ::getrlimit(RLIMIT_CPU, &cpu);
    return files.rlim_max > 64 || size.rlim_max > 0 ||
           cpu.rlim_max > static_cast<rlim_t>(ReadingLimits().time_s) + 1;
  }));
}

}  // namespace
}  // namespace aisle::sim
