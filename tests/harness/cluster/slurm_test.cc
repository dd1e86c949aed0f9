#include "harness/cluster/slurm.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/io/input_error.h"

namespace aisle {
namespace {

using testing::HasSubstr;
using testing::Not;

SlurmPaths Paths() {
  return {.program = "/opt/ai sle", .out = "/srv/it's 5%/out", .working_folder = "/srv"};
}

TEST(SlurmTest, ATaskSaysWhatItNeedsAndNoMore) {
  const std::string bare = TaskScript({0, "0-3"}, {.name = "aisle-x"}, Paths());
  EXPECT_THAT(bare, HasSubstr("#SBATCH --array=0-3\n"));
  EXPECT_THAT(bare, Not(HasSubstr("--partition")));
  EXPECT_THAT(bare, Not(HasSubstr("--time")));
  const std::string full = TaskScript(
      {1001, "2,4"},
      {.name = "aisle-x", .partition = "night", .time = "2:00:00", .cpus = 4, .at_most = 16},
      Paths());
  EXPECT_THAT(full, HasSubstr("#SBATCH --array=2,4%16\n"));
  EXPECT_THAT(full, HasSubstr("#SBATCH --partition=\"night\"\n"));
  EXPECT_THAT(full, HasSubstr("#SBATCH --time=\"2:00:00\"\n"));
  EXPECT_THAT(full, HasSubstr("#SBATCH --cpus-per-task=4\n"));
  EXPECT_THAT(full, HasSubstr("--offset 1001\n"));
}

TEST(SlurmTest, ScriptsHoldAwkwardPaths) {
  const std::string script = TaskScript({0, "0"}, {.name = "aisle-x"}, Paths());
  EXPECT_THAT(script, HasSubstr("exec '/opt/ai sle' run-task '/srv/it'\\''s 5%/out' --offset 0\n"));
  EXPECT_THAT(script, HasSubstr("--output=\"/srv/it's 5%%/out/cluster/log/%A_%a.txt\""));
  SlurmPaths bad = Paths();
  bad.out = "/srv/a\nexec rm";
  EXPECT_THROW(TaskScript({0, "0"}, {.name = "aisle-x"}, bad), InputError);
  EXPECT_THROW(MergeScript("now", {.name = "a\"b"}, Paths()), InputError);
}

TEST(SlurmTest, CountsItsOwnJobsAlone) {
  const Submission ours{.id = "x", .arrays = {"12", "13"}, .merge = "14"};
  const auto states = CountStates(
      "12|RUNNING\n12|RUNNING\n12|PENDING\n120|PENDING\n1|RUNNING\n14|PENDING\nslurm: a word\n",
      ours);
  EXPECT_EQ(states, (std::map<std::string, int>{{"RUNNING", 2}, {"PENDING", 2}}));
  EXPECT_TRUE(CountStates("", ours).empty());
}

}  // namespace
}  // namespace aisle
