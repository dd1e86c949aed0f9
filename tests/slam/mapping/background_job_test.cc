#include "slam/mapping/background_job.h"

#include <gtest/gtest.h>

#include <atomic>

namespace aisle::slam {
namespace {

TEST(BackgroundJob, WorkThatIsReplacedIsNotWaitedForUntilAResultIsTaken) {
  std::promise<void> leave;
  std::atomic<bool> ended = false;
  BackgroundJob<int> job;
  job.Start(5, true, [&, may_leave = leave.get_future().share()] {
    may_leave.wait_for(std::chrono::seconds(20));  // a limit only for where this test fails
    ended = true;
    return 1;
  });
  job.Start(3, true, [] { return 2; });
  EXPECT_FALSE(ended);
  EXPECT_EQ(job.due_frame(), 3);
  double wait_ms = 0;
  EXPECT_FALSE(job.TakeIfDue(2, wait_ms));
  EXPECT_FALSE(job.TakeIfDue(2, wait_ms, true));  // what is replaced still reads what it was given
  leave.set_value();
  EXPECT_EQ(job.TakeIfDue(3, wait_ms), 2);
  EXPECT_TRUE(ended);
  EXPECT_FALSE(job.pending());
}

TEST(BackgroundJob, WorkThatIsReplacedBeforeItsTurnIsNotDone) {
  bool begun = false;
  BackgroundJob<int> job;
  job.Start(5, false, [&] { return begun = true, 1; });
  job.Start(3, false, [] { return 2; });
  double wait_ms = 0;
  EXPECT_EQ(job.TakeIfDue(3, wait_ms), 2);
  EXPECT_FALSE(begun);
}

TEST(BackgroundJob, WorkThatIsReplacedHasEndedWhenTheJobHas) {
  std::atomic<bool> ended = false;
  {
    BackgroundJob<int> job;
    job.Start(5, true, [&] { return ended = true, 1; });
    job.Start(3, true, [] { return 2; });
  }
  EXPECT_TRUE(ended);
}

}  // namespace
}  // namespace aisle::slam
