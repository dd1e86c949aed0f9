#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace aisle {

enum class CommitState { kGood, kBad, kCannotTell };

/// What was found of one commit.
struct CommitTrial {
  std::string commit;
  CommitState state = CommitState::kCannotTell;
  std::string why = {};  ///< "ate_rmse_m 0.021 m", "the build failed: …"
};

struct BisectOutcome {
  std::vector<std::string> suspects;  ///< one of these is the first bad commit; usually one alone
  std::vector<CommitTrial> trials;    ///< in the order in which they were made
};

/// Looks for the first bad one of `commits`, oldest first, of which the last is known to be bad and
/// the one before the first to be good. Commits that cannot be told are passed over, their
/// neighbours tried instead; what lies between the last good and the first bad one stays suspect.
BisectOutcome Bisect(const std::vector<std::string>& commits,
                     const std::function<CommitTrial(const std::string&)>& attempt);

/// A checkout of somebody's repository, beside it: their own files are not touched. One folder for
/// all commits, so that a build need not begin anew for each.
class SourceTree {
 public:
  /// Throws InputError where there is no such repository, MachineError where git fails.
  SourceTree(std::filesystem::path repository, std::filesystem::path folder);
  ~SourceTree();
  SourceTree(const SourceTree&) = delete;
  SourceTree& operator=(const SourceTree&) = delete;

  const std::filesystem::path& folder() const { return folder_; }
  void CheckOut(const std::string& commit) const;

 private:
  std::filesystem::path repository_, folder_;
};

/// The commit of a tag, a branch or a shorter name, in full. Throws InputError where it is none.
std::string FullCommit(const std::filesystem::path& repository, const std::string& name);

/// The commits after `good` up to and with `bad`, along the first parents, oldest first, in full.
/// Throws InputError where one is none, or `good` does not lie before `bad`.
std::vector<std::string> CommitsBetween(const std::filesystem::path& repository,
                                        const std::string& good, const std::string& bad);

/// "1a2b3c4 2026-01-12 Author: subject".
std::string DescribeCommit(const std::filesystem::path& repository, const std::string& commit);

}  // namespace aisle
