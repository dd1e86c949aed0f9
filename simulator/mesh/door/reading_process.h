#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "simulator/mesh/door/confine.h"

namespace aisle::sim {

/// How a process ended, and what it left.
struct Reading {
  enum class End { kExited, kSignalled, kTooLong, kTooMuch };
  End end = End::kExited;
  int code = 0;           ///< exit code, or the signal's number
  std::string bytes;      ///< of its stdout
  std::string complaint;  ///< of its stderr, the first of it
};

/// Runs a program to its end, with nothing of ours but its arguments and two pipes, and takes what
/// it writes: no more than `most_bytes`, no longer than the limits allow, then it is killed. Safe
/// to be called from several threads. Throws std::system_error where it cannot be started.
Reading RunReader(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                  const ReadingLimits& limits, std::size_t most_bytes);

}  // namespace aisle::sim
