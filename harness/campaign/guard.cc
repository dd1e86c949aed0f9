#include "harness/campaign/guard.h"

#include <fcntl.h>
#include <linux/capability.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "harness/campaign/own_memory.h"

namespace aisle {
namespace {

constexpr int kNotStarted = 127;  ///< a shell's code for a command that cannot be found

void DieWithParent(int signal, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, signal);
  if (::getppid() != parent) ::_exit(kNotStarted);  // it died before the line above
}

/// Only standard streams stay open: a guard must not hold its parent's locks and pipes. The rules
/// move to the descriptor above them.
constexpr int kRuleset = STDERR_FILENO + 1;
void KeepOnly(const GuardedCommand& command) {
  // Out of the way of the descriptors that are taken next, whatever their numbers.
  const int output = ::fcntl(command.output, F_DUPFD, kRuleset + 1);
  const int ruleset = command.ruleset < 0 ? -1 : ::fcntl(command.ruleset, F_DUPFD, kRuleset + 1);
  const int null = ::open("/dev/null", O_RDONLY);
  const int input = command.input < 0 ? null : ::fcntl(command.input, F_DUPFD, kRuleset + 1);
  const int talk = command.talk < 0 ? output : ::fcntl(command.talk, F_DUPFD, kRuleset + 1);
  ::dup2(input, STDIN_FILENO);
  ::dup2(talk, STDOUT_FILENO);
  ::dup2(output, STDERR_FILENO);
  if (ruleset >= 0) ::dup2(ruleset, kRuleset);
  ::close_range(static_cast<unsigned>(ruleset >= 0 ? kRuleset + 1 : kRuleset), ~0U, 0);
}

/// What a program of others must not be able to do, where this process could. The command goes on
/// as the same user.
void GiveUpRights(const GuardedCommand& command) {
  // Some kernels let us take it and some do not; the command can work with either.
  if (command.own_shared_memory) {
    const int ruleset = command.ruleset < 0 ? -1 : kRuleset;
    TakeOwnSharedMemory({.ruleset = ruleset, .access = command.shared_memory_access});
  }
  constexpr int kSystemRights[] = {CAP_SYS_ADMIN,  CAP_SYS_MODULE,      CAP_SYS_RAWIO,
                                   CAP_SYS_PTRACE, CAP_SYS_BOOT,        CAP_MKNOD,
                                   CAP_SYS_TIME,   CAP_DAC_READ_SEARCH, CAP_LINUX_IMMUTABLE};
  for (const int right : kSystemRights) ::prctl(PR_CAPBSET_DROP, right);
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  constexpr rlim_t kLargestFile = rlim_t{16} << 30;
  const rlimit size{kLargestFile, kLargestFile};
  ::setrlimit(RLIMIT_FSIZE, &size);
  if (command.ruleset < 0) return;
  // Rather not at all than unbound.
  if (::syscall(SYS_landlock_restrict_self, kRuleset, 0) != 0) ::_exit(kNotStarted);
  ::close(kRuleset);
}

pid_t Start(const GuardedCommand& command, const sigset_t& mask) {
  const pid_t guard = ::getpid();
  const pid_t child = ::fork();
  if (child != 0) return child;
  DieWithParent(SIGKILL, guard);
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  if (command.foreign) GiveUpRights(command);
  ::sigprocmask(SIG_SETMASK, &mask, nullptr);
  ::execve(command.argv[0], command.argv, command.environment);
  ::_exit(kNotStarted);
}

/// Sends SIGKILL to every child; false where there is none.
bool KillChildren() {
  char list[8192];
  const int file = ::open("/proc/thread-self/children", O_RDONLY | O_CLOEXEC);
  const ssize_t length = file < 0 ? 0 : ::read(file, list, sizeof list);
  if (file >= 0) ::close(file);
  bool any = false;
  pid_t pid = 0;
  for (ssize_t i = 0; i < length; ++i) {  // "12 345 ": each number ends in a blank
    if (list[i] != ' ') {
      pid = pid * 10 + (list[i] - '0');
      continue;
    }
    any = ::kill(pid, SIGKILL) == 0 || any;
    pid = 0;
  }
  return any;
}

/// Ends every descendant: the orphans of those that die become children of this process, which is
/// their reaper, and die in the next round.
void EndAll() {
  while (KillChildren()) {
    ::waitpid(-1, nullptr, 0);
    while (::waitpid(-1, nullptr, WNOHANG) > 0) {
    }
  }
}

[[noreturn]] void EndAs(int status) {
  if (WIFSIGNALED(status)) {
    sigset_t all;
    ::sigfillset(&all);
    ::signal(WTERMSIG(status), SIG_DFL);
    ::sigprocmask(SIG_UNBLOCK, &all, nullptr);
    ::kill(::getpid(), WTERMSIG(status));
  }
  ::_exit(WEXITSTATUS(status));
}

/// Buries what has died; true when `child` was among it.
bool Bury(pid_t child, int* status) {
  bool ended = false;
  int of_any = 0;
  for (pid_t pid; (pid = ::waitpid(-1, &of_any, WNOHANG)) > 0;) {
    if (pid != child) continue;
    *status = of_any;
    ended = true;
  }
  return ended;
}

}  // namespace

sigset_t GuardedSignals() {
  sigset_t signals;
  ::sigemptyset(&signals);
  ::sigaddset(&signals, SIGCHLD);
  ::sigaddset(&signals, SIGTERM);
  return signals;
}

void Guard(const GuardedCommand& command, int parent, const sigset_t& before) {
  ::setsid();
  ::prctl(PR_SET_NAME, kGuardName);
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  DieWithParent(SIGTERM, parent);
  KeepOnly(command);

  const sigset_t watched = GuardedSignals();
  const pid_t child = Start(command, before);
  int status = kNotStarted << 8;
  while (child > 0) {
    const int signal = ::sigwaitinfo(&watched, nullptr);
    if (signal == SIGTERM) {
      ::kill(child, SIGKILL);  // at least, where the kernel does not list children
      EndAll();
      ::_exit(kNotStarted);
    }
    if (signal == SIGCHLD && Bury(child, &status)) break;
  }
  EndAll();
  EndAs(status);
}

}  // namespace aisle
