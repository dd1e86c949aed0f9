#pragma once

#include <signal.h>

#include <cstdint>

namespace aisle {

/// What a guard starts.
struct GuardedCommand {
  char* const* argv;
  char* const* environment;
  int output;        ///< descriptor where stdout and stderr go
  int input = -1;    ///< where stdin comes from; -1: nothing to read
  int talk = -1;     ///< where stdout goes instead; -1: with stderr
  int ruleset = -1;  ///< Landlock rules that the command is bound to; -1: none
  /// Whether it gets a /dev/shm of its own, and what the rules allow it there.
  bool own_shared_memory = false;
  std::uint64_t shared_memory_access = 0;
  /// Whose command it is: one of others may gain no rights by what it starts, has given up those
  /// that reach around the file system, and may not fill the disk by one file.
  bool foreign = false;
};

/// Becomes the guard of one command, after a fork and for good: a process that starts it, ends as
/// the command ends (same exit code or signal), and takes everything the command ever started with
/// it, daemons that left its session too. It does the same at SIGTERM and when `parent` dies, by
/// SIGKILL even. Only calls that are allowed between fork and exec of a threaded program are made.
/// GuardedSignals() must have been blocked before the fork; the command gets the mask of `before`.
[[noreturn]] void Guard(const GuardedCommand& command, int parent, const sigset_t& before);

/// What a guard waits for.
sigset_t GuardedSignals();

/// What guards are called in /proc/PID/comm: they share their parent's memory and count for none.
inline constexpr const char* kGuardName = "aisle-guard";

}  // namespace aisle
