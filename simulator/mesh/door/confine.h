#pragma once

#include <cstddef>
#include <filesystem>

namespace aisle::sim {

/// What a process may spend on one file.
struct ReadingLimits {
  std::size_t memory_bytes = std::size_t{4} << 30;  ///< of address space
  double time_s = 120;                              ///< of the clock; of the processor too
};

/// Binds this process, for good: it reads below one folder and writes nowhere, opens no connection,
/// starts nothing, cannot look into other processes, has no more memory and time than that, and
/// dies with its parent. Files go by Landlock, calls by a filter of the kernel (seccomp); a kernel
/// that has not got one of them does without. Throws std::runtime_error where a kernel that has
/// them refuses.
void ConfineThisProcess(const std::filesystem::path& readable_folder, const ReadingLimits& limits);

/// Whether it bounds memory: not in builds with a sanitizer, which reserves terabytes of address
/// space.
bool BoundsMemory();

}  // namespace aisle::sim
