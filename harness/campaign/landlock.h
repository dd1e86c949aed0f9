#pragma once

#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>

namespace aisle {

// The kernel's interface as of version 6, stated here: Debian's header knows version 2.

struct LandlockRuleset {
  std::uint64_t file_access = 0, network_access = 0, scopes = 0;
};

struct LandlockPathRule {
  std::uint64_t access;
  std::int32_t parent;
} __attribute__((packed));

/// Allows access to a file or folder, by its descriptor, and to all below it. False, and errno,
/// where the kernel refuses. May be called between fork and exec.
inline bool AddPathRule(int ruleset, int parent, std::uint64_t access) {
  constexpr int kPathBeneath = 1;
  const LandlockPathRule rule{.access = access, .parent = parent};
  return ::syscall(SYS_landlock_add_rule, ruleset, kPathBeneath, &rule, 0) == 0;
}

}  // namespace aisle
