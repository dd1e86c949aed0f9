#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/io/descriptor.h"

namespace aisle {

/// What a command of others may touch.
struct SandboxRules {
  /// Files and folders whose content it must not see: truth, and what other runs left. Beside these
  /// (among the folders on the way to them) reports and histories of other nights are hidden too.
  std::vector<std::filesystem::path> hidden;
  /// Folders where it may read and write, below hidden ones even. Nowhere else may it write, but to
  /// /dev/shm (the machine's, or one of its own: own_memory.h) and devices that hold nothing.
  std::vector<std::filesystem::path> writable;
};

/// What the kernel holds commands of others to: the version of its Landlock interface, 0 where it
/// has none.
int SandboxLevel();

/// The same in words, for `doctor` and for logs.
std::string DescribeSandbox(int level = SandboxLevel());

/// Rules as the kernel takes them (Landlock), ready for a process to be bound to; whoever is bound
/// stays so with all it starts. Names of files can be listed everywhere, hidden ones too; what is
/// neither readable nor writable by these rules gives "Permission denied".
class Sandbox {
 public:
  /// Where the kernel has no Landlock, nobody is held back. Where it has, throws MachineError if a
  /// writable folder is not there or the rules cannot be made: better no run than one held to
  /// others.
  explicit Sandbox(const SandboxRules& rules);
  Sandbox(const Sandbox&) = delete;
  Sandbox& operator=(const Sandbox&) = delete;

  /// A descriptor for landlock_restrict_self, or -1.
  int ruleset() const { return ruleset_.get(); }
  /// What is allowed in a writable folder, as the kernel calls it.
  std::uint64_t writing() const { return writing_; }

 private:
  Descriptor ruleset_;
  std::uint64_t writing_ = 0;
};

/// The environment of such a command, "NAME=VALUE" each: paths, locale and what steers Python,
/// CUDA, OpenMP and ROS, those in `more`, and TMPDIR as given. No token or secret of the night goes
/// along.
std::vector<std::string> ScrubbedEnvironment(const std::filesystem::path& tmpdir,
                                             const std::vector<std::string>& more);

}  // namespace aisle
