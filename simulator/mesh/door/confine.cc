#include "simulator/mesh/door/confine.h"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace aisle::sim {
namespace {

[[noreturn]] void Fail(const char* what) {
  throw std::runtime_error(fmt::format("cannot be confined: {}: {}", what, std::strerror(errno)));
}

void Limit(__rlimit_resource_t resource, rlim_t most) {
  const rlimit limit{most, most};
  if (::setrlimit(resource, &limit) != 0) Fail("setrlimit");
}

void LimitSpending(const ReadingLimits& limits) {
  Limit(RLIMIT_CORE, 0);
  Limit(RLIMIT_FSIZE, 0);  // pipes are no files
  Limit(RLIMIT_NOFILE, 64);
  Limit(RLIMIT_CPU, static_cast<rlim_t>(limits.time_s) + 1);
  if (BoundsMemory()) Limit(RLIMIT_AS, limits.memory_bytes);
}

// Landlock's interface as of version 6, stated here: Debian's header knows version 2.
struct RulesetAttributes {
  std::uint64_t file_access = 0, network_access = 0, scopes = 0;
};
struct PathRule {
  std::uint64_t access;
  std::int32_t parent;
} __attribute__((packed));
constexpr std::uint64_t kReadFile = 1 << 2, kReadFolder = 1 << 3;
constexpr unsigned kAskVersion = 1;
constexpr int kPathBeneath = 1;

/// All that a version of the interface can forbid.
RulesetAttributes EverythingOf(long version) {
  RulesetAttributes all;
  all.file_access = (1u << 13) - 1;               // version 1: run, write, read, list, remove, make
  if (version >= 2) all.file_access |= 1u << 13;  // move between folders
  if (version >= 3) all.file_access |= 1u << 14;  // cut short
  if (version >= 5) all.file_access |= 1u << 15;  // command devices
  if (version >= 4) all.network_access = 3;       // bind and connect by TCP
  if (version >= 6) all.scopes = 3;               // sockets without a name, signals
  return all;
}

std::size_t AttributeBytes(long version) {
  return sizeof(std::uint64_t) * (version >= 6 ? 3 : version >= 4 ? 2 : 1);
}

void ForbidFilesBut(const std::filesystem::path& readable_folder) {
  const long version = ::syscall(SYS_landlock_create_ruleset, nullptr, 0, kAskVersion);
  if (version < 1) return;
  const RulesetAttributes everything = EverythingOf(version);
  const auto rules = static_cast<int>(
      ::syscall(SYS_landlock_create_ruleset, &everything, AttributeBytes(version), 0));
  if (rules < 0) Fail("landlock_create_ruleset");
  const int folder = ::open(readable_folder.c_str(), O_PATH | O_CLOEXEC);
  if (folder >= 0) {  // else nothing can be read, which the reader will say
    const PathRule rule{.access = kReadFile | kReadFolder, .parent = folder};
    if (::syscall(SYS_landlock_add_rule, rules, kPathBeneath, &rule, 0) != 0) {
      Fail("landlock_add_rule");
    }
    ::close(folder);
  }
  if (::syscall(SYS_landlock_restrict_self, rules, 0) != 0) Fail("landlock_restrict_self");
  ::close(rules);
}

constexpr sock_filter Statement(unsigned code, std::uint32_t k) {
  return {static_cast<std::uint16_t>(code), 0, 0, k};
}
constexpr sock_filter Jump(unsigned code, std::uint32_t k, std::uint8_t yes, std::uint8_t no) {
  return {static_cast<std::uint16_t>(code), yes, no, k};
}

/// Calls that no reader of a file has a use for, each of them a way out.
constexpr std::array kForbidden = {SYS_socket,
                                   SYS_socketpair,
                                   SYS_connect,
                                   SYS_execve,
                                   SYS_execveat,
                                   SYS_fork,
                                   SYS_vfork,
                                   SYS_clone,
                                   SYS_clone3,
                                   SYS_ptrace,
                                   SYS_process_vm_readv,
                                   SYS_process_vm_writev,
                                   SYS_kill,
                                   SYS_tkill,
                                   SYS_rt_sigqueueinfo,
                                   SYS_rt_tgsigqueueinfo,
                                   SYS_pidfd_send_signal,
                                   SYS_pidfd_open,
                                   SYS_pidfd_getfd,
                                   SYS_io_uring_setup,
                                   SYS_bpf,
                                   SYS_perf_event_open,
                                   SYS_mount,
                                   SYS_unshare,
                                   SYS_setns,
                                   SYS_chroot,
                                   SYS_pivot_root,
                                   SYS_keyctl,
                                   SYS_add_key,
                                   SYS_userfaultfd,
                                   SYS_open_by_handle_at,
                                   SYS_shmget,
                                   SYS_shmat,
                                   SYS_msgget};

/// They fail with "Operation not permitted"; another machine's calls end the process.
void ForbidCalls() {
#if defined(__x86_64__)
  constexpr std::uint32_t kOldPointers = 0x40000000;  // x32's calls have other numbers
  std::vector<sock_filter> program = {
      Statement(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, arch)),
      Jump(BPF_JMP | BPF_JEQ | BPF_K, AUDIT_ARCH_X86_64, 1, 0),
      Statement(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS),
      Statement(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      Jump(BPF_JMP | BPF_JGE | BPF_K, kOldPointers, 0, 1),
      Statement(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS)};
  for (const long call : kForbidden) {
    program.push_back(Jump(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, 1));
    program.push_back(Statement(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM));
  }
  // To its own threads it may send signals, as abort() does.
  program.insert(program.end(),
                 {Jump(BPF_JMP | BPF_JEQ | BPF_K, SYS_tgkill, 0, 3),
                  Statement(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, args)),
                  Jump(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(::getpid()), 1, 0),
                  Statement(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM)});
  program.push_back(Statement(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  const sock_fprog filter{static_cast<unsigned short>(program.size()), program.data()};
  const bool known = ::prctl(PR_GET_SECCOMP, 0, 0, 0, 0) >= 0;
  if (::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) != 0 && known) Fail("seccomp");
#endif
}

}  // namespace

bool BoundsMemory() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return false;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
  return false;
#endif
#endif
  return true;
}

void ConfineThisProcess(const std::filesystem::path& readable_folder, const ReadingLimits& limits) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  LimitSpending(limits);
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) Fail("no_new_privs");
  ForbidFilesBut(readable_folder);
  ForbidCalls();
}

}  // namespace aisle::sim
