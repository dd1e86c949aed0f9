#include "harness/campaign/schedule.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <exception>
#include <filesystem>
#include <queue>
#include <random>

#include "harness/io/input_error.h"
#include "harness/record/record.h"
#include "tests/harness/campaign/job_of.h"

namespace aisle {
namespace {

using test::JobOf;

std::vector<std::string> Ids(const std::vector<Job>& jobs) {
  std::vector<std::string> ids;
  for (const Job& job : jobs) ids.push_back(RunId(job.spec));
  return ids;
}

TEST(ScheduleTest, TheLongestComesFirstAndFramesStayTogether) {
  const std::vector<Job> jobs{JobOf("short", "plain"), JobOf("long", "plain"),
                              JobOf("short", "robust"), JobOf("long", "robust"),
                              JobOf("long", "oracle")};
  EXPECT_THAT(Ids(LongestFirst(jobs, {{"short/live/plain/1", {5, 1}},
                                      {"short/live/robust/1", {6, 1}},
                                      {"long/live/plain/1", {2, 4}},
                                      {"long/live/robust/1", {2, 4}},
                                      {"long/live/oracle/1", {5, 4}}})),
              testing::ElementsAre("long/live/oracle/1", "long/live/plain/1", "long/live/robust/1",
                                   "short/live/robust/1", "short/live/plain/1"));
}

TEST(ScheduleTest, WithoutTimesTheOrderIsThePlans) {
  const std::vector<Job> jobs{JobOf("a", "plain"), JobOf("a", "robust"), JobOf("b", "plain")};
  EXPECT_EQ(Ids(LongestFirst(jobs, {})), Ids(jobs));
}

TEST(ScheduleTest, ARunMayTakeAsLongAsItsCommandAndOurOwnWorkBesideIt) {
  Job ours = JobOf("a", "plain"), theirs = ours;
  theirs.spec.system = {.name = "mine",
                        .like = "",
                        .options = {},
                        .mask_errors = {},
                        .external = ExternalSystem{.command = "x {output}", .timeout_s = 7200}};
  EXPECT_EQ(ProcessLimitsOf(ours, {}).wall_s, 3600);
  EXPECT_GT(ProcessLimitsOf(theirs, {}).wall_s, 7200);
  EXPECT_EQ(ProcessLimitsOf(theirs, {.wall_s = 60}).wall_s, 60) << "who asks for it has it";
  theirs.spec.system.external->dataset = kStreamFormat;  // its `timeout_s` is that of one answer
  EXPECT_EQ(ProcessLimitsOf(theirs, {}).wall_s, 3600);
  EXPECT_EQ(ProcessLimitsOf(ours, {.memory_mib = 9}).memory_mib, 9);
}

/// When the last of the jobs ends, each taken by the first worker that is free.
double EndOf(const std::vector<Job>& jobs, const ExpectedTimes& expected, int workers) {
  std::priority_queue<double, std::vector<double>, std::greater<>> free_at;
  for (int i = 0; i < workers; ++i) free_at.push(0);
  double end = 0;
  for (const Job& job : jobs) {
    const double done = free_at.top() + expected.at(RunId(job.spec)).drive_s;
    free_at.pop();
    free_at.push(done);
    end = std::max(end, done);
  }
  return end;
}

TEST(ScheduleTest, ANightEndsCloseToItsBound) {
  // Ten scenes of one to ten shares of work, six systems each, of which one is four times as slow;
  // in the plan the longest scene, with its slow system, comes last.
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> jitter(0.8, 1.2);
  std::vector<Job> jobs;
  ExpectedTimes expected;
  double all_s = 0;
  for (int scene = 1; scene <= 10; ++scene) {
    for (const char* system : {"a", "b", "c", "d", "e", "slow"}) {
      jobs.push_back(JobOf(std::to_string(scene), system));
      const double job_s = scene * (system == std::string("slow") ? 4 : 1) * jitter(random);
      all_s += expected[RunId(jobs.back().spec)].drive_s = job_s;
    }
  }
  for (const int workers : {2, 4, 8}) {
    const double bound_s = all_s / workers;
    EXPECT_LT(EndOf(LongestFirst(jobs, expected), expected, workers), 1.05 * bound_s) << workers;
  }
  EXPECT_GT(EndOf(jobs, expected, 8), 1.3 * all_s / 8);  // as planned
}

/// The script of a job that a test has named by it.
std::vector<std::string> ScriptOf(const Job& job) { return {"/bin/sh", "-c", job.spec.scene}; }

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
  EXPECT_EQ(ended[1].end, ProcessResult::End::kSignalled);
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
    job.frames = "/frames/shared";
    jobs.push_back(job);
  }
  int good = 0;
  const auto note = [&](const Job&, const ProcessResult& r) { good += r.code == 0; };
  EXPECT_TRUE(
      RunJobs(jobs, {.jobs = 2, .limits = {}}, {.argv = ScriptOf, .ended = note, .tick = {}}));
  EXPECT_EQ(good, 2);
}

TEST(ScheduleTest, WhoKeepsNothingWaitsForNobody) {
  const std::string met = testing::TempDir() + fmt::format("aisle_met_{}", ::getpid());
  // Each of the two leaves its own mark and waits for the other's.
  const std::string script = "mkdir " + met + "{} && for i in $(seq 100); do test -d " + met +
                             "{} && exit 0; sleep 0.1; done; exit 9";
  std::vector<Job> jobs(2);
  for (std::size_t i = 0; i < 2; ++i) {
    jobs[i].spec.scene = fmt::format(fmt::runtime(script), i, 1 - i);
    jobs[i].frames_key = "the same scene's";
  }
  int good = 0;
  const auto note = [&](const Job&, const ProcessResult& r) { good += r.code == 0; };
  EXPECT_TRUE(
      RunJobs(jobs, {.jobs = 2, .limits = {}}, {.argv = ScriptOf, .ended = note, .tick = {}}));
  EXPECT_EQ(good, 2);
  for (const char* mark : {"0", "1"}) std::filesystem::remove(met + mark);
}

/// Takes all descriptors but those that are open, or gives them back.
void LimitDescriptors(bool few) {
  static const rlimit before = [] {
    rlimit now{};
    ::getrlimit(RLIMIT_NOFILE, &now);
    return now;
  }();
  const rlimit none{0, before.rlim_max};
  ::setrlimit(RLIMIT_NOFILE, few ? &none : &before);
}

TEST(ScheduleTest, AJobThatCannotBeStartedIsTriedAgain) {
  std::vector<Job> jobs(3);
  for (Job& job : jobs) job.spec.scene = "sleep 0.2";
  int asked = 0, good = 0;
  const auto argv = [&](const Job& job) {
    LimitDescriptors(++asked == 2);  // there is no room for the second while the first runs
    return ScriptOf(job);
  };
  const auto note = [&](const Job&, const ProcessResult& r) { good += r.code == 0; };
  EXPECT_TRUE(RunJobs(jobs, {.jobs = 2, .limits = {}}, {.argv = argv, .ended = note, .tick = {}}));
  EXPECT_EQ(good, 3);
  EXPECT_EQ(asked, 4);
}

TEST(ScheduleTest, WhereNothingCanBeStartedTheMachineIsToBlame) {
  const std::vector<Job> jobs(1);
  const auto argv = [&](const Job& job) {
    LimitDescriptors(true);
    return ScriptOf(job);
  };
  std::exception_ptr thrown;
  try {
    RunJobs(jobs, {.jobs = 1, .limits = {}}, {.argv = argv, .ended = {}, .tick = {}});
  } catch (...) {
    thrown = std::current_exception();
  }
  LimitDescriptors(false);
  ASSERT_TRUE(thrown);
  EXPECT_THROW(std::rethrow_exception(thrown), MachineError);
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
