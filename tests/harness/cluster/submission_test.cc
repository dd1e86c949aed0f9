#include "harness/cluster/submission.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "harness/cluster/tasks.h"

namespace aisle {
namespace {

TEST(SubmissionTest, AFolderThatBeginsAnotherNightAnswersForNone) {
  const std::filesystem::path out =
      std::filesystem::temp_directory_path() / fmt::format("aisle_forgets_{}", ::getpid());
  ForgetNight(out);  // where there is none
  WriteSubmission({.id = "a", .arrays = {"1"}, .merge = "2"}, out);
  WriteVerdict({.submission = "a", .exit_code = 0}, out);
  WriteTasks({}, out);
  ForgetNight(out);
  EXPECT_FALSE(ReadSubmission(out));
  EXPECT_FALSE(ReadVerdict(out));
  EXPECT_FALSE(HasTasks(out));
  std::filesystem::remove_all(out);
}

}  // namespace
}  // namespace aisle
