#pragma once

#include <signal.h>

namespace aisle {

/// Becomes the guard of one command, after a fork and for good: a process that starts `argv` with
/// stdout and stderr going to the descriptor `output`, ends as the command ends (same exit code or
/// signal), and takes everything the command ever started with it, daemons that left its session
/// too. It does the same at SIGTERM and when `parent` dies, by SIGKILL even. Only calls that are
/// allowed between fork and exec of a threaded program are made. GuardedSignals() must have been
/// blocked before the fork; the command gets the mask of `before`.
[[noreturn]] void Guard(char* const* argv, int output, int parent, const sigset_t& before);

/// What a guard waits for.
sigset_t GuardedSignals();

/// What guards are called in /proc/PID/comm: they share their parent's memory and count for none.
inline constexpr const char* kGuardName = "aisle-guard";

}  // namespace aisle
