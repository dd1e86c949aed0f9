#pragma once

#include <filesystem>
#include <string>

namespace aisle {

struct MergeNightOptions {
  bool json = false;       ///< results.json on stdout instead of the table
  std::string submission;  ///< whose verdict it is, for those who wait for it; empty: nobody does
};

/// Makes report and verdict of a folder that a cluster's tasks filled, from their files alone, and
/// returns the exit code. What is planned and not there is waited for as long as the folder's
/// settings say: network file systems show new files late. Throws InputError.
int MergeNight(const std::filesystem::path& out, const MergeNightOptions& options);

}  // namespace aisle
