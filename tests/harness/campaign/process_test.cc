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

#include "harness/campaign/schedule.h"

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
            "exit code 139: signal 11, SIGSEGV (Segmentation fault), as a shell tells it");
  EXPECT_EQ(Describe(RunToEnd("exit 255"), {}), "exit code 255");
}

TEST(ProcessTest, TheLastLineNeedsNoEnd) { EXPECT_EQ(RunToEnd("printf end").log, "end\n"); }

/// A file for the number of a process that should not outlive its test.
std::string PidFile(const std::string& name) {
  return testing::TempDir() + fmt::format("aisle_{}_{}", name, ::getpid());
}

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
  const std::string file = PidFile("grandchild");
  const ProcessLimits limits{.wall_s = 2};
  const ProcessResult result = RunToEnd("sleep 100 & echo $! > " + file + "; wait", limits);
  EXPECT_EQ(result.end, End::kTimeout);
  EXPECT_EQ(Describe(result, limits), "no end after 2 s: killed");
  EXPECT_TRUE(IsGone(file));
}

/// Leaves its parent, its group and its session, as daemons do.
std::string Daemon(const std::string& pid_file) {
  return "(setsid sh -c 'echo $$ > " + pid_file + "; exec sleep 100' &) ; sleep 0.3;";
}

TEST(ProcessTest, DaemonsEndWithTheCommandThatStartedThem) {
  const std::string file = PidFile("daemon");
  EXPECT_EQ(RunToEnd(Daemon(file) + "exit 4").code, 4);
  EXPECT_TRUE(IsGone(file));
}

TEST(ProcessTest, AllEndsWhenTheHarnessItselfIsKilled) {
  const std::string file = PidFile("orphan");
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

TEST(ProcessTest, ProgressLinesAreReadAndNotLogged) {
  Process process(Shell("echo '@progress 3 10'; echo hello"), {});
  while (!process.Poll()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(process.progress_done(), 3);
  EXPECT_EQ(process.progress_total(), 10);
  EXPECT_EQ(process.result().log, "hello\n");
}

TEST(ProcessTest, AProgramThatIsNotThereExits127) {
  Process process({"/no/such/program"}, {});
  while (!process.Poll()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(process.result().code, 127);
}

/// The script of a job that a test has named by it.
std::vector<std::string> ScriptOf(const Job& job) { return Shell(job.spec.scene); }

TEST(ScheduleTest, OneSystemsCrashTouchesNoOther) {
  std::vector<Job> jobs;
  const char* scripts[] = {"exit 0", "kill -SEGV $$", "exit 0", "exit 3"};
  for (int i = 0; i < 4; ++i) {
    Job job;
    job.spec.seed = static_cast<std::uint64_t>(i);
    job.spec.scene = scripts[i];
    job.frames_key = "same";
    jobs.push_back(job);
  }
  std::map<std::uint64_t, ProcessResult> ended;
  const auto note = [&](const Job& job, const ProcessResult& r) { ended[job.spec.seed] = r; };
  EXPECT_TRUE(
      RunJobs(jobs, {.jobs = 3, .limits = {}}, {.argv = ScriptOf, .ended = note, .tick = {}}));
  ASSERT_EQ(ended.size(), 4u);
  EXPECT_EQ(ended[0].code, 0);
  EXPECT_EQ(ended[1].end, End::kSignalled);
  EXPECT_EQ(ended[2].code, 0);
  EXPECT_EQ(ended[3].code, 3);
}

TEST(ScheduleTest, FramesAreMadeByOneJobAtATime) {
  const std::string lock = testing::TempDir() + fmt::format("aisle_lock_{}", ::getpid());
  // The first to come makes the folder; a second one beside it would fail.
  const std::string script = "mkdir " + lock + " || exit 9; sleep 0.2; rmdir " + lock;
  std::vector<Job> jobs;
  for (int i = 0; i < 2; ++i) {
    Job job;
    job.spec.scene = i == 0 ? script : "test ! -d " + lock;
    job.frames_key = "shared";
    jobs.push_back(job);
  }
  int good = 0;
  const auto note = [&](const Job&, const ProcessResult& r) { good += r.code == 0; };
  EXPECT_TRUE(
      RunJobs(jobs, {.jobs = 2, .limits = {}}, {.argv = ScriptOf, .ended = note, .tick = {}}));
  EXPECT_EQ(good, 2);
}

TEST(ScheduleTest, AnInterruptEndsWhatRuns) {
  std::atomic<bool> interrupted = false;
  Job job;
  job.spec.scene = "sleep 100";
  const auto stop = [&](const std::vector<JobProgress>&, std::size_t) { interrupted = true; };
  EXPECT_FALSE(RunJobs({job}, {.jobs = 1, .limits = {}, .interrupted = &interrupted},
                       {.argv = ScriptOf, .ended = {}, .tick = stop}));
}

}  // namespace
}  // namespace aisle
