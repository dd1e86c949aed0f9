#pragma once

#include <sys/types.h>

#include <filesystem>
#include <map>
#include <vector>

namespace aisle {

/// Modes of files and folders, and of the folders around them, to be put back: a program of others
/// may take away the access to whatever its user owns, since Landlock does not regulate that, and
/// so lock us out of our own report. Access is given back and never taken away, so that any number
/// of runs may do so at once, whatever of it they have found taken away already.
class FolderModes {
 public:
  /// What is not there is left alone.
  explicit FolderModes(const std::vector<std::filesystem::path>& paths = {}) { Add(paths); }
  ~FolderModes() { PutBack(); }
  FolderModes(const FolderModes&) = delete;
  FolderModes& operator=(const FolderModes&) = delete;

  void Add(const std::vector<std::filesystem::path>& paths);

  /// Where anything of the paths' own modes is missing, or the owner's access to a folder around
  /// them: there others may have their reasons to change the rest. One look-up each.
  void PutBack() const;

 private:
  struct Mode {
    mode_t mode = 0, watched = 0;  ///< bits, and those that are put back when they are missing
  };
  void Remember(const std::filesystem::path& path);

  std::map<std::filesystem::path, Mode> modes_;  ///< folders come before what is in them
};

}  // namespace aisle
