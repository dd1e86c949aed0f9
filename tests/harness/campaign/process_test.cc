// Whatever a child does, the harness goes on: the children here are shell scripts that misbehave.
#include "harness/campaign/process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <thread>

namespace aisle {
namespace {

using End = ProcessResult::End;

std::vector<std::string> Shell(const std::string& script) { return {"/bin/sh", "-c", script}; }

ProcessResult RunToEnd(const std::string& script, const ProcessLimits& limits = {}) {
  Process process(Shell(script), limits);
  while (!process.Poll()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  return process.result();
}

TEST(ProcessTest, ExitCodesAndOutputComeBack) {
  const ProcessResult result = RunToEnd("echo out; echo err >&2; exit 7");
  EXPECT_EQ(result.end, End::kExited);
  EXPECT_EQ(result.code, 7);
  EXPECT_EQ(result.log, "out\nerr\n");
  EXPECT_EQ(Describe(result, {}), "exit code 7");
}

TEST(ProcessTest, ACrashIsASignal) {
  const ProcessResult result = RunToEnd("kill -SEGV $$");
  EXPECT_EQ(result.end, End::kSignalled);
  EXPECT_EQ(Describe(result, {}), "signal 11, SIGSEGV (Segmentation fault)");
}

TEST(ProcessTest, ASignalToldByAShellIsNamed) {
  const ProcessResult result = RunToEnd("sh -c 'kill -SEGV $$'; exit $?");
  EXPECT_EQ(Describe(result, {}),
            "exit code 139: signal 11, SIGSEGV (Segmentation fault), as reported by the shell");
  EXPECT_EQ(Describe(RunToEnd("exit 255"), {}), "exit code 255");
}

TEST(ProcessTest, TheLastLineNeedsNoEnd) { EXPECT_EQ(RunToEnd("printf end").log, "end\n"); }

/// A file for the number of a process that should not outlive its test.
/// Where a process leaves its number; goes with its owner.
class PidFile {
 public:
  explicit PidFile(const std::string& name)
      : path_(testing::TempDir() + fmt::format("aisle_{}_{}", name, ::getpid())) {}
  PidFile(const PidFile&) = delete;
  PidFile& operator=(const PidFile&) = delete;
  ~PidFile() { std::filesystem::remove(path_); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Whether the process whose number the file holds is dead, or will be within two seconds.
bool IsGone(const std::string& pid_file) {
  pid_t pid = 0;
  for (int i = 0; i < 200; ++i) {
    if (pid <= 1) std::ifstream(pid_file) >> pid;
    std::ifstream stat(fmt::format("/proc/{}/stat", pid));
    std::string number, name, state = "gone";
    stat >> number >> name >> state;
    if (pid > 1 && (state == "gone" || state == "Z")) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

TEST(ProcessTest, AHangIsEndedWithAllItsChildren) {
  const PidFile number("grandchild");
  const std::string& file = number.path();
  const ProcessLimits limits{.wall_s = 2};
  const ProcessResult result = RunToEnd("sleep 100 & echo $! > " + file + "; wait", limits);
  EXPECT_EQ(result.end, End::kTimeout);
  EXPECT_EQ(Describe(result, limits), "killed after 2 s without an end");
  EXPECT_TRUE(IsGone(file));
}

/// Leaves its parent, its group and its session, as daemons do.
std::string Daemon(const std::string& pid_file) {
  return "(setsid sh -c 'echo $$ > " + pid_file + "; exec sleep 100' &) ; sleep 0.3;";
}

TEST(ProcessTest, DaemonsEndWithTheCommandThatStartedThem) {
  const PidFile number("daemon");
  const std::string& file = number.path();
  EXPECT_EQ(RunToEnd(Daemon(file) + "exit 4").code, 4);
  EXPECT_TRUE(IsGone(file));
}

TEST(ProcessTest, AllEndsWhenTheHarnessItselfIsKilled) {
  const PidFile number("orphan");
  const std::string& file = number.path();
  const pid_t harness = ::fork();
  if (harness == 0) {
    Process process(Shell(Daemon(file) + "sleep 100"), {});
    for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
  }
  for (int i = 0; i < 500 && !std::filesystem::exists(file); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ::kill(harness, SIGKILL);
  ::waitpid(harness, nullptr, 0);
  EXPECT_TRUE(IsGone(file));
}

TEST(ProcessTest, AFloodOfOutputKeepsItsTailOnly) {
  const ProcessLimits limits{.log_bytes = 1000};
  const ProcessResult result = RunToEnd("yes flood | head -c 3000000; echo; echo end", limits);
  EXPECT_EQ(result.code, 0);
  EXPECT_LE(result.log.size(), 2001u);
  EXPECT_THAT(result.log, testing::EndsWith("end\n"));
}

TEST(ProcessTest, TooMuchMemoryIsNoticed) {
  const ProcessLimits limits{.wall_s = 20, .memory_mib = 60};
  // It is the command's child that takes it.
  const ProcessResult result =
      RunToEnd("head -c 200000000 /dev/zero | tail -c 150000000 | (sleep 20; cat)", limits);
  EXPECT_EQ(result.end, End::kMemory);
}

TEST(ProcessTest, MemoryThatProcessesShareCountsOnce) {
  // Five processes of 60 MiB each, which they share, look like 300.
  const ProcessResult result = RunToEnd(
      R"(exec python3 -c '
import mmap, os, time
shared = mmap.mmap(-1, 60 << 20, mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)
shared.write(b"x" * (60 << 20))
for worker in range(4):
    if os.fork() == 0:
        assert all(shared[at] == 120 for at in range(0, 60 << 20, 4096))
        time.sleep(1.5)
        os._exit(0)
for worker in range(4):
    assert os.wait()[1] == 0
')",
      {.wall_s = 60, .memory_mib = 150});
  EXPECT_EQ(result.end, End::kExited) << result.log;
  EXPECT_EQ(result.code, 0) << result.log;
  EXPECT_GT(result.peak_rss_mib, 60);
  EXPECT_LE(result.peak_rss_mib, 150);
}

/// Whether it ends within ten seconds.
bool Ends(Process& process) {
  for (int round = 0; round < 1000; ++round) {
    if (process.Poll()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

TEST(ProcessTest, WhoStartedUsMayIgnoreTheDeathOfChildren) {
  const auto before = ::signal(SIGCHLD, SIG_IGN);
  Process process(Shell("sleep 0.1; exit 7"), {.wall_s = 5});
  const bool ends = Ends(process);
  ::signal(SIGCHLD, before);
  ASSERT_TRUE(ends);
  EXPECT_EQ(process.result().end, End::kExited);
  EXPECT_EQ(process.result().code, 7);
}

TEST(ProcessTest, AnEndThatWentToAnotherIsAnEnd) {
  Process process(Shell("echo said; exit 7"), {});
  EXPECT_GT(::waitpid(-1, nullptr, 0), 0);
  ASSERT_TRUE(Ends(process));
  EXPECT_NE(process.result().code, 0);
  EXPECT_EQ(process.result().log, "said\n");
  EXPECT_EQ(Describe(process.result(), {}), "ended, but its exit code went to another wait");
}

TEST(ProcessTest, StagesOfAProgramOfOthersAreItsOwnWords) {
  Process process(Shell("echo '@progress 3 10'; echo '@stage mapping'"), {},
                  Confinement{.environment = {"PATH=/usr/bin:/bin"}});
  ASSERT_TRUE(Ends(process));
  EXPECT_EQ(process.progress().done, 3);
  EXPECT_EQ(process.progress().stage, "");
  EXPECT_EQ(process.result().log, "@stage mapping\n");
}

TEST(ProcessTest, ProgressLinesAreReadAndNotLogged) {
  Process process(Shell("echo '@progress 3 10'; echo hello"), {});
  while (!process.Poll()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(process.progress().done, 3);
  EXPECT_EQ(process.progress().total, 10);
  EXPECT_EQ(process.result().log, "hello\n");
}

TEST(ProcessTest, AProgramThatIsNotThereExits127) {
  Process process({"/no/such/program"}, {});
  while (!process.Poll()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(process.result().code, 127);
}

}  // namespace
}  // namespace aisle
