#include "harness/campaign/bisect.h"

#include <chrono>
#include <sstream>
#include <thread>

#include "harness/campaign/process.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

ProcessResult Git(const fs::path& repository, const std::vector<std::string>& words) {
  std::vector<std::string> argv{"/usr/bin/env", "git", "-C", repository.string()};
  argv.insert(argv.end(), words.begin(), words.end());
  Process process(argv, {.wall_s = 600, .log_bytes = std::size_t{16} << 20});
  while (!process.Poll()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return process.result();
}

bool EndedWell(const ProcessResult& result) {
  return result.end == ProcessResult::End::kExited && result.code == 0;
}

/// The untried commit nearest to the middle of what is still open; `end` where there is none.
std::size_t NextToTry(std::size_t first, std::size_t end, const std::vector<bool>& tried) {
  std::size_t next = end;
  const std::size_t middle = (first + end) / 2;
  const auto distance = [&](std::size_t i) { return std::max(i, middle) - std::min(i, middle); };
  for (std::size_t i = first; i < end; ++i) {
    if (!tried[i] && (next == end || distance(i) < distance(next))) next = i;
  }
  return next;
}

}  // namespace

BisectOutcome Bisect(const std::vector<std::string>& commits,
                     const std::function<CommitTrial(const std::string&)>& attempt) {
  BisectOutcome outcome;
  std::vector<bool> tried(commits.size(), false);
  std::size_t first = 0, last = commits.size() - 1;  // the first bad one is in [first, last]
  for (std::size_t at; (at = NextToTry(first, last, tried)) != last;) {
    tried[at] = true;
    outcome.trials.push_back(attempt(commits[at]));
    if (outcome.trials.back().state == CommitState::kGood) first = at + 1;
    if (outcome.trials.back().state == CommitState::kBad) last = at;
  }
  outcome.suspects.assign(commits.begin() + static_cast<std::ptrdiff_t>(first),
                          commits.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  return outcome;
}

SourceTree::SourceTree(fs::path repository, fs::path folder)
    : repository_(std::move(repository)), folder_(fs::absolute(std::move(folder))) {
  if (!EndedWell(Git(repository_, {"rev-parse", "--git-dir"}))) {
    throw InputError(repository_.string(), 0, "not a git repository");
  }
  Git(repository_, {"worktree", "remove", "--force", folder_.string()});  // of one that was killed
  Git(repository_, {"worktree", "prune"});
  RemoveFolder(folder_);
  const ProcessResult made =
      Git(repository_, {"worktree", "add", "--detach", folder_.string(), "HEAD"});
  if (!EndedWell(made)) {
    throw MachineError(
        fmt::format("{}: cannot check it out: {}", repository_.string(), TellingLine(made.log)));
  }
}

SourceTree::~SourceTree() { Git(repository_, {"worktree", "remove", "--force", folder_.string()}); }

void SourceTree::CheckOut(const std::string& commit) const {
  const ProcessResult done = Git(folder_, {"checkout", "--quiet", "--force", "--detach", commit});
  if (!EndedWell(done)) {
    throw MachineError(fmt::format("{}: cannot check out {}: {}", repository_.string(), commit,
                                   TellingLine(done.log)));
  }
}

std::string FullCommit(const fs::path& repository, const std::string& name) {
  // What git could take for an option is no name of a commit.
  const bool plain = !name.empty() && name.front() != '-';
  const ProcessResult found =
      plain ? Git(repository, {"rev-parse", "--verify", "--quiet", name + "^{commit}"})
            : ProcessResult{.code = 1, .log = {}};
  if (!EndedWell(found)) {
    throw InputError(
        repository.string(), 0,
        fmt::format("has no commit '{}'; expected a hash, a tag or a branch", Printable(name)));
  }
  return found.log.substr(0, found.log.find('\n'));
}

std::vector<std::string> CommitsBetween(const fs::path& repository, const std::string& good,
                                        const std::string& bad) {
  if (!EndedWell(Git(repository, {"rev-parse", "--git-dir"}))) {
    throw InputError(repository.string(), 0, "not a git repository");
  }
  const std::string from = FullCommit(repository, good), to = FullCommit(repository, bad);
  const ProcessResult list =
      Git(repository, {"rev-list", "--first-parent", "--reverse", from + ".." + to});
  std::vector<std::string> commits;
  std::istringstream stream(list.log);
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty()) commits.push_back(line);
  }
  const bool before = EndedWell(Git(repository, {"merge-base", "--is-ancestor", from, to}));
  if (commits.empty() || !before) {
    throw InputError(repository.string(), 0,
                     fmt::format("{} is not an ancestor of {}: give the good commit first",
                                 Printable(good), Printable(bad)));
  }
  return commits;
}

std::string DescribeCommit(const fs::path& repository, const std::string& commit) {
  const ProcessResult said =
      Git(repository, {"log", "-1", "--date=short", "--format=%h %ad %an: %s", commit});
  return Printable(said.log.substr(0, said.log.find('\n')), 160);
}

}  // namespace aisle
