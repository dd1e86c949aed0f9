#pragma once

#include <filesystem>
#include <string>

namespace aisle {

struct MergeNightOptions {
  bool json = false;       ///< results.json on stdout instead of the table
  std::string submission;  ///< whose verdict it is; empty: somebody merges by hand
};

/// Makes report and verdict of a folder that a cluster's tasks filled, from their files alone, and
/// returns the exit code, which is filed as the verdict of what was submitted; where jobs of that
/// may still be to come, a merge by hand is no verdict. The folder is the caller's. What is planned
/// and not there is waited for as long as the folder's settings say: network file systems show new
/// files late. Throws InputError.
int MergeNight(const std::filesystem::path& out, const MergeNightOptions& options);

}  // namespace aisle
