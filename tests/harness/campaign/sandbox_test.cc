// What a program of others can reach: shell scripts that try.
#include "harness/campaign/sandbox.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <exception>
#include <thread>

#include "harness/campaign/folder_modes.h"
#include "harness/campaign/own_memory.h"
#include "harness/campaign/process.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

class SandboxTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / fmt::format("aisle_sandbox_{}", ::getpid());
    for (const char* room : {"nights/tonight/runs", "nights/yesterday", "nights/tools", "own"}) {
      fs::create_directories(folder_ / room);
    }
    WriteFileAtomically(folder_ / "nights/tonight/runs/truth.txt", "truth");
    WriteFileAtomically(folder_ / "nights/yesterday/results.json", "truth");
    WriteFileAtomically(folder_ / "nights/yesterday/junit.xml", "truth");
    WriteFileAtomically(folder_ / "nights/history.sqlite", "truth");
    WriteFileAtomically(folder_ / "nights/tools/words.txt", "words");
    WriteFileAtomically(folder_ / "scene.yaml", "truth");
  }
  void TearDown() override { RemoveFolder(folder_); }

  ProcessResult Try(const std::string& script) const {
    const Sandbox sandbox({.hidden = {folder_ / "nights/tonight", folder_ / "scene.yaml"},
                           .writable = {folder_ / "own"}});
    Process process(
        {"/bin/sh", "-c", "cd " + folder_.string() + "\n" + script}, {.wall_s = 20},
        Confinement{.environment = ScrubbedEnvironment(folder_ / "own", {"AISLE_TEST_ASKED"}),
                    .ruleset = sandbox.ruleset(),
                    .own_shared_memory = CanOwnSharedMemory(),
                    .shared_memory_access = sandbox.writing()});
    while (!process.Poll()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return process.result();
  }

  fs::path folder_;
};

/// Where the kernel holds nobody back there is nothing to see.
class BoundSandboxTest : public SandboxTest {
 protected:
  void SetUp() override {
    if (SandboxLevel() < 6) GTEST_SKIP() << DescribeSandbox();
    SandboxTest::SetUp();
  }
};

TEST_F(BoundSandboxTest, TruthAndOtherNightsCannotBeRead) {
  for (const char* file : {"nights/tonight/runs/truth.txt", "nights/yesterday/results.json",
                           "nights/history.sqlite", "scene.yaml"}) {
    const ProcessResult result = Try(std::string("cat ") + file);
    EXPECT_NE(result.code, 0) << file;
    EXPECT_THAT(result.log, HasSubstr("Permission denied")) << file;
    EXPECT_THAT(result.log, Not(HasSubstr("truth\n"))) << file;
  }
  // By another name, by another folder's name, or as a link, they are what they are.
  EXPECT_NE(Try("ln scene.yaml own/mine && cat own/mine").code, 0);
  EXPECT_NE(Try("ln -s ../scene.yaml own/mine; cat own/mine").code, 0);
  EXPECT_NE(Try("mv nights/tonight own/").code, 0);
  EXPECT_NE(Try("cd nights/tonight/runs && cat truth.txt").code, 0);
}

TEST_F(BoundSandboxTest, ASecondAttemptWithinANightSeesNoneOfIt) {
  WriteFileAtomically(folder_ / "nights/plan.json", "truth");
  fs::create_directories(folder_ / "nights/runs");
  WriteFileAtomically(folder_ / "nights/runs/truth.txt", "truth");
  EXPECT_NE(Try("cat nights/runs/truth.txt").code, 0);
}

TEST_F(BoundSandboxTest, WhatItNeedsCanBeRead) {
  const ProcessResult result =
      Try("cat nights/tools/words.txt; ls nights >/dev/null && echo listed; echo x >own/x && cat "
          "own/x; mktemp >/dev/null && echo temporary; echo null >/dev/null && head -c 1 "
          "/dev/zero >/dev/null && echo devices");
  EXPECT_EQ(result.log, "wordslisted\nx\ntemporary\ndevices\n");
}

TEST_F(BoundSandboxTest, NothingElseCanBeWritten) {
  for (const std::string script :
       {"echo x >>scene.yaml", "echo x >new", "mkdir new", "rm scene.yaml", "mv scene.yaml new",
        "echo x >nights/tools/words.txt", "rm -r nights/tonight", "ln -s / new", "mkfifo new",
        "truncate -s 0 nights/tools/words.txt", "echo x >/tmp/aisle_sandbox_new",
        "mknod own/disk b 8 0", "cp /bin/true nights/tools/true"}) {
    EXPECT_NE(Try(script).code, 0) << script;
  }
  EXPECT_EQ(ReadFile(folder_ / "scene.yaml"), "truth");
  EXPECT_EQ(ReadFile(folder_ / "nights/tools/words.txt"), "words");
  EXPECT_FALSE(fs::exists(folder_ / "new"));
}

/// Landlock lets it; what it does to our folders is undone.
TEST_F(BoundSandboxTest, ModesThatItChangesArePutBack) {
  const fs::path night = folder_ / "nights/tonight";
  const fs::perms before = fs::status(night).permissions();
  {
    const FolderModes modes({night});
    EXPECT_EQ(Try("chmod 0 nights/tonight").code, 0);
    EXPECT_NE(fs::status(night).permissions(), before);
  }
  EXPECT_EQ(fs::status(night).permissions(), before);
}

/// Better no run than one that is held to other rules, or to none.
TEST_F(BoundSandboxTest, RulesThatCannotBeMadeAreTheMachinesTrouble) {
  const SandboxRules rules{.hidden = {folder_ / "nights"}, .writable = {folder_ / "own"}};
  rlimit before{};
  ::getrlimit(RLIMIT_NOFILE, &before);
  const int next = ::dup(STDIN_FILENO);  // the lowest that is free
  ::close(next);
  const auto free = static_cast<rlim_t>(next);
  for (const rlim_t most : {free, free + 1, free + 2}) {
    std::exception_ptr thrown;  // judged when there are descriptors again: UBSan needs a pipe
    const rlimit few{most, before.rlim_max};
    ::setrlimit(RLIMIT_NOFILE, &few);
    try {
      const Sandbox sandbox(rules);
    } catch (...) {
      thrown = std::current_exception();
    }
    ::setrlimit(RLIMIT_NOFILE, &before);
    EXPECT_EQ(thrown != nullptr, most < free + 2) << "two are enough";
    if (thrown) {
      EXPECT_THROW(std::rethrow_exception(thrown), MachineError);
    }
  }
  EXPECT_THROW(Sandbox({.hidden = {}, .writable = {folder_ / "none"}}), MachineError);
  EXPECT_NO_THROW(Sandbox({.hidden = {folder_ / "none"}, .writable = {folder_ / "own"}}));
}

TEST_F(BoundSandboxTest, OthersCannotBeSignalled) {
  const pid_t other = ::fork();
  if (other == 0) {
    ::sleep(20);
    ::_exit(0);
  }
  EXPECT_NE(Try(fmt::format("kill -KILL {}", other)).code, 0);
  EXPECT_EQ(Try("sleep 20 & kill $!; wait $!; test $? -gt 128").code, 0);  // its own can
  EXPECT_EQ(::waitpid(other, nullptr, WNOHANG), 0);
  ::kill(other, SIGKILL);
  ::waitpid(other, nullptr, 0);
}

TEST(DescribeSandboxTest, WhatAKernelCannotPreventIsOneSentence) {
  const std::string cannot = "; this kernel cannot keep them from ";
  const std::string kills = "sending signals to other processes of the user";
  EXPECT_THAT(DescribeSandbox(6), Not(HasSubstr("cannot")));
  EXPECT_THAT(DescribeSandbox(6), HasSubstr("modes"));
  for (const int level : {3, 4, 5}) {
    EXPECT_THAT(DescribeSandbox(level), EndsWith("are put back)" + cannot + kills));
  }
  for (const int level : {1, 2}) {
    EXPECT_THAT(DescribeSandbox(level),
                EndsWith("are put back)" + cannot + "cutting files short nor from " + kills));
  }
}

TEST_F(SandboxTest, NeitherSecretsNorDescriptorsGoAlong) {
  ::setenv("AISLE_TEST_TOKEN", "secret", 1);
  ::setenv("AISLE_TEST_ASKED", "for", 1);
  const int open = ::dup(STDIN_FILENO);
  const ProcessResult result = Try("env; echo \"$TMPDIR\"; ls /proc/self/fd | wc -l");
  ::close(open);
  EXPECT_THAT(result.log, Not(HasSubstr("secret")));
  EXPECT_THAT(result.log, HasSubstr("AISLE_TEST_ASKED=for\n"));
  EXPECT_THAT(result.log, HasSubstr("PATH="));
  EXPECT_THAT(result.log, HasSubstr("TMPDIR=" + (folder_ / "own").string()));
  EXPECT_THAT(result.log, testing::EndsWith("\n4\n"));  // three, and that of the list itself
}

TEST_F(SandboxTest, WhatItLeavesInSharedMemoryGoesWithIt) {
  if (!CanOwnSharedMemory()) GTEST_SKIP() << "this kernel gives no /dev/shm of one's own";
  const std::string ours = fmt::format("/dev/shm/aisle_ours_{}", ::getpid());
  const std::string theirs = fmt::format("/dev/shm/aisle_theirs_{}", ::getpid());
  WriteFileAtomically(ours, "ours");
  const ProcessResult result =
      Try(fmt::format("ls -A /dev/shm; echo x >{0} && cat {0}; id -u", theirs));
  EXPECT_EQ(result.log, fmt::format("x\n{}\n", ::geteuid()));
  EXPECT_FALSE(fs::exists(theirs));
  for (const std::string& file : {ours, theirs}) fs::remove(file);
}

TEST_F(SandboxTest, OneFileCannotFillTheDisk) { EXPECT_NE(Try("truncate -s 60G own/big").code, 0); }

}  // namespace
}  // namespace aisle
