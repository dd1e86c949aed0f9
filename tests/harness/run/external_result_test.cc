#include "harness/run/external_result.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace aisle {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr std::int64_t kStep_ns = 50'000'000;
constexpr std::int64_t kEpoch_ns = 1'600'000'000'000'000'000;

Trajectory Poses(std::int64_t from_ns, std::int64_t step_ns, int count) {
  Trajectory poses;
  for (int i = 0; i < count; ++i) {
    poses.push_back({from_ns + i * step_ns, Eigen::Isometry3d::Identity()});
  }
  return poses;
}

RunResult Of(const Trajectory& estimate, double min_coverage = kMinCoverage) {
  return ResultFromTrajectory(Poses(0, kStep_ns, 40), estimate, min_coverage, kEpoch_ns);
}

TEST(ExternalResultTest, StampsOfAnotherClockAreToldAsTheSystemSawThem) {
  const RunResult run = Of(Poses(-kEpoch_ns, kStep_ns, 40));
  EXPECT_EQ(run.status, RunStatus::kLost);
  EXPECT_EQ(
      run.status_why,
      "poses for only 0 of 40 frames; 0 of 40 poses have a frame's timestamp: they range "
      "from 0.000 to 1.950 s, but the dataset's frames from 1600000000.000 to 1600000001.950 s");
}

TEST(ExternalResultTest, StampsInAnotherUnitAreToldSo) {
  const RunResult run = ResultFromTrajectory(Poses(kStep_ns, kStep_ns, 40),
                                             Poses(1000 * kStep_ns, 1000 * kStep_ns, 40));
  EXPECT_THAT(run.status_why, AllOf(HasSubstr("times 0.001"), HasSubstr("in milliseconds?")));
}

/// Of a system that leaves key frames alone no coverage is asked, but stamps of frames are.
TEST(ExternalResultTest, WhereNoCoverageIsAskedForeignStampsAreInvalid) {
  EXPECT_EQ(Of(Poses(0, 5 * kStep_ns, 8), 0).status, RunStatus::kOk) << "key frames";
  EXPECT_EQ(Of(Poses(kStep_ns / 3, kStep_ns, 40), 0).status, RunStatus::kOk) << "a third late";
  EXPECT_EQ(Of(Poses(0, kStep_ns / 10, 400), 0).status, RunStatus::kOk) << "at an IMU's rate";
  const RunResult wrong = Of(Poses(0, kStep_ns / 1000, 40), 0);
  EXPECT_EQ(wrong.status, RunStatus::kInvalid);
  EXPECT_THAT(wrong.status_why, HasSubstr("1 of 40 poses have a frame's timestamp"));
  EXPECT_TRUE(wrong.trajectory.final.empty());
}

TEST(ExternalResultTest, ASystemThatIsOnlyLostIsToldOfNoStamps) {
  EXPECT_EQ(Of(Poses(0, kStep_ns, 4)).status_why, "poses for only 4 of 40 frames");
  EXPECT_EQ(Of({}).status_why, "poses for only 0 of 40 frames");
}

}  // namespace
}  // namespace aisle
