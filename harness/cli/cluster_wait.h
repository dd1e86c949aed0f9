#pragma once

#include <filesystem>
#include <string>

#include "harness/cluster/submission.h"
#include "harness/cluster/tasks.h"

namespace aisle {

struct WaitOptions {
  bool json = false;  ///< results.json on stdout instead of the summary
};

/// "31 of 40 runs | 2 RUNNING, 4 PENDING", from the folder's files and the queue.
std::string ClusterProgress(const TaskList& list, const std::filesystem::path& out,
                            const std::optional<Submission>& submission);

/// Follows the submission of a folder to its verdict and returns that exit code. Where the jobs are
/// gone and no verdict came (the merge was killed), it merges here. Interrupted, it leaves the jobs
/// as they are. Throws InputError where nothing was submitted.
int WaitForVerdict(const std::filesystem::path& out, const WaitOptions& options);

}  // namespace aisle
