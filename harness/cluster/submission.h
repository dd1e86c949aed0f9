#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace aisle {

/// What was handed to the batch system last; cluster/submission.json.
struct Submission {
  std::string id;                   ///< of its own: a verdict answers one submission
  std::vector<std::string> arrays;  ///< job numbers of the tasks
  std::string merge;                ///< job number of the merge; empty where none was submitted

  bool operator==(const Submission&) const = default;
};

/// What the merge of a submission ended with; cluster/verdict.json.
struct ClusterVerdict {
  std::string submission;  ///< empty: of tasks that aisle did not submit itself (Kubernetes)
  int exit_code = 0;

  bool operator==(const ClusterVerdict&) const = default;
};

// Each is written whole, so that nobody reads half of it; absent where there is none or it is
// damaged: whoever asks then knows as much as before.
void WriteSubmission(const Submission& submission, const std::filesystem::path& out);
std::optional<Submission> ReadSubmission(const std::filesystem::path& out);
void WriteVerdict(const ClusterVerdict& verdict, const std::filesystem::path& out);
std::optional<ClusterVerdict> ReadVerdict(const std::filesystem::path& out);

/// Takes both away, the verdict first, and the list of the tasks: a folder that begins another
/// night answers for none, and holds another plan than theirs.
void ForgetNight(const std::filesystem::path& out);

}  // namespace aisle
