#pragma once

#include <filesystem>
#include <optional>

#include "harness/io/file_lock.h"

namespace aisle {

/// A folder of a task's own on its node, gone with the task. What tasks that were killed left there
/// is taken away when the next one begins.
class Scratch {
 public:
  /// Below `base`/aisle-USER. Throws MachineError.
  explicit Scratch(const std::filesystem::path& base);
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  const std::filesystem::path& folder() const { return folder_; }
  /// Of all this user's tasks on the node.
  const std::filesystem::path& home() const { return home_; }
  /// Shared by this user's tasks on the node, and kept: light and frames are found by content.
  std::filesystem::path cache() const { return home_ / "cache"; }

 private:
  std::filesystem::path home_, folder_;
  std::optional<FileLock> held_;  ///< while it is, the folder is somebody's
};

}  // namespace aisle
