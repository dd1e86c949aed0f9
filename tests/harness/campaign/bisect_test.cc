#include "harness/campaign/bisect.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <set>

#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

std::vector<std::string> Commits(int count) {
  std::vector<std::string> commits;
  for (int i = 0; i < count; ++i) commits.push_back(std::to_string(i));
  return commits;
}

/// Every commit from `bad` on is bad, those of `broken` cannot be told.
BisectOutcome Search(int count, int bad, const std::set<int>& broken = {}) {
  return Bisect(Commits(count), [&](const std::string& commit) {
    const int number = std::stoi(commit);
    return CommitTrial{commit,
                       broken.contains(number) ? CommitState::kCannotTell
                       : number >= bad         ? CommitState::kBad
                                               : CommitState::kGood,
                       ""};
  });
}

TEST(BisectTest, FindsTheFirstBadCommitInFewTrials) {
  for (int bad = 0; bad < 37; ++bad) {
    const BisectOutcome outcome = Search(37, bad);
    EXPECT_THAT(outcome.suspects, ElementsAre(std::to_string(bad)));
    EXPECT_LE(outcome.trials.size(), 6u);
  }
  EXPECT_THAT(Search(1, 0).trials, SizeIs(0));  // the one between is it
}

TEST(BisectTest, WhatCannotBeToldIsPassedOverAndStaysSuspect) {
  EXPECT_THAT(Search(9, 6, {4, 3}).suspects, ElementsAre("6"));
  EXPECT_THAT(Search(9, 5, {3, 4}).suspects, ElementsAre("3", "4", "5"));
}

class SourceTreeTest : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(repository_);
    Git("init -q . && git config user.name a && git config user.email a@b");
    for (const char* text : {"one", "two", "three"}) {
      std::ofstream(repository_ / "file") << text;
      Git(fmt::format("add file && git commit -qm '{}' && git tag {}", text, text));
    }
  }
  void TearDown() override { fs::remove_all(folder_); }
  void Git(const std::string& words) const {
    const std::string command = fmt::format("cd '{}' && git {}", repository_.string(), words);
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
  }
  std::string TextIn(const fs::path& folder) const {
    std::string text;
    std::ifstream(folder / "file") >> text;
    return text;
  }
  const fs::path folder_ = fs::temp_directory_path() / fmt::format("aisle_bisect_{}", ::getpid());
  const fs::path repository_ = folder_ / "repository";
};

TEST_F(SourceTreeTest, CommitsComeOldestFirstAndTheUsersFilesStay) {
  const auto commits = CommitsBetween(repository_, "one", "HEAD");
  ASSERT_THAT(commits, SizeIs(2));
  EXPECT_THAT(DescribeCommit(repository_, commits[0]), HasSubstr("a: two"));
  {
    const SourceTree tree(repository_, folder_ / "checkout");
    tree.CheckOut(commits[0]);
    EXPECT_EQ(TextIn(tree.folder()), "two");
    tree.CheckOut("one");
    EXPECT_EQ(TextIn(tree.folder()), "one");
    EXPECT_EQ(TextIn(repository_), "three");
  }
  EXPECT_FALSE(fs::exists(folder_ / "checkout"));
}

TEST_F(SourceTreeTest, WhatIsNoCommitOrNoRepositoryIsSaid) {
  EXPECT_THROW(CommitsBetween(repository_, "one", "nine"), InputError);
  EXPECT_THROW(CommitsBetween(repository_, "--all", "three"), InputError);
  EXPECT_THROW(CommitsBetween(repository_, "three", "one"), InputError);
  EXPECT_THROW(CommitsBetween(folder_, "one", "two"), InputError);
}

}  // namespace
}  // namespace aisle
