#pragma once

#include <cstdint>

namespace aisle {

/// What a command that has a /dev/shm of its own may do there, as Landlock calls it.
struct SharedMemoryRule {
  int ruleset = -1;  ///< -1: none
  std::uint64_t access = 0;
};

/// Gives this process and all that it starts an empty /dev/shm in place of the machine's; it goes
/// with the last of them. Nothing else of the file system changes for them, and a user stays who he
/// is. False where the kernel does not let us. For a child between fork and exec.
bool TakeOwnSharedMemory(const SharedMemoryRule& rule);

/// Whether it would, as a child found out that tried; asked once.
bool CanOwnSharedMemory();

}  // namespace aisle
