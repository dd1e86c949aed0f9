#include "harness/cli/score_input.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <sys/stat.h>
#include <unistd.h>

#include <thread>

#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/io/trajectory.h"
#include "tests/support/arbitrary.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

/// Where four numbers of a rotation have w.
enum class Order { kFirst, kLast };

/// 8 columns, stamps in whole nanoseconds.
std::string Rows(const Trajectory& poses, Order order) {
  std::string rows;
  for (const StampedPose& pose : poses) {
    const Eigen::Vector3d p = pose.T_world_rig.translation();
    const Eigen::Quaterniond q(pose.T_world_rig.linear());
    rows += fmt::format("{} {} {} {} ", pose.stamp_ns, p.x(), p.y(), p.z());
    rows += order == Order::kFirst ? fmt::format("{} {} {} {}\n", q.w(), q.x(), q.y(), q.z())
                                   : fmt::format("{} {} {} {}\n", q.x(), q.y(), q.z(), q.w());
  }
  return rows;
}

Eigen::Vector3d AnyVector(double most) {
  return {AnyNumberIn(-most, most), AnyNumberIn(-most, most), AnyNumberIn(-most, most)};
}

/// A smooth way of twenty seconds that goes and turns by waves of any size, seen by a rig that is
/// mounted in any way.
Trajectory AnySmoothTrajectory(double most_turn_rad) {
  const Eigen::Vector3d sway_m = AnyVector(3), turn = AnyVector(most_turn_rad);
  const Eigen::Vector3d pace = AnyVector(1), phase = AnyVector(3);
  const Eigen::Isometry3d T_rig_mounted = AnyPose();
  Trajectory trajectory;
  for (int i = 0; i < 200; ++i) {
    const double s = 0.1 * i;
    const Eigen::Array3d wave = (pace.array() * s + phase.array()).sin();
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = sway_m.array() * wave + 0.3 * s;
    const Eigen::Vector3d v = turn.array() * (0.7 * pace.array() * s + phase.array()).cos();
    if (v.norm() > 0)
      pose.linear() = Eigen::AngleAxisd(v.norm(), v.normalized()).toRotationMatrix();
    pose.linear() = pose.linear() * T_rig_mounted.linear();
    trajectory.push_back({1'403'636'579'763'555'584 + i * 100'000'000LL, pose});
  }
  return trajectory;
}

Trajectory Circle(const Eigen::Matrix3d& mounting) {
  Trajectory circle;
  for (int i = 0; i < 200; ++i) {
    const Eigen::AngleAxisd heading(0.05 * i, Eigen::Vector3d::UnitZ());
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = heading * Eigen::Vector3d(0, -4, 0);
    pose.linear() = heading * mounting;
    circle.push_back({1'403'636'579'763'555'584 + i * 100'000'000LL, pose});
  }
  return circle;
}

class ScoreInputTest : public testing::Test {
 protected:
  void TearDown() override { fs::remove_all(folder_); }
  std::string Write(const std::string& name, const std::string& text) const {
    WriteFileAtomically(folder_ / name, text, Durability::kSurvivesProcessLoss);
    return (folder_ / name).string();
  }
  const fs::path folder_ = fs::temp_directory_path() / fmt::format("aisle_in_{}", ::getpid());
};

double LargestTurnDeg(const Trajectory& a, const Trajectory& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Eigen::Matrix3d turn = a[i].T_world_rig.linear().transpose() * b[i].T_world_rig.linear();
    largest = std::max(largest, Eigen::AngleAxisd(turn).angle() * 180 / M_PI);
  }
  return largest;
}

/// Of any motion: rightly, or not at all.
TEST_F(ScoreInputTest, NoEstimateIsReadWithItsRotationTurnedRound) {
  EXPECT_TRUE(rc::check([this] {
    const Trajectory truth = AnySmoothTrajectory(AnyNumberIn(0, 2));
    Trajectory estimate = truth;  // in a world of its own, and not without error
    const Eigen::Isometry3d moved = AnyPose();
    for (StampedPose& pose : estimate) {
      pose.T_world_rig = moved * pose.T_world_rig;
      pose.T_world_rig.translation() += AnyVector(0.003);
    }
    const Order order = AnyFlag() ? Order::kFirst : Order::kLast;
    const PoseFiles files{
        .truth = Write("truth.txt", FormatTrajectory(truth, TrajectoryFormat::kTum)),
        .estimates = {Write("estimate.txt", Rows(estimate, order))}};
    try {
      const PosesRead read = ReadPoseFiles(files).estimates.front();
      RC_ASSERT(LargestTurnDeg(read.poses, estimate) < 1e-6);
      RC_ASSERT(!read.note.empty());
    } catch (const InputError& error) {
      RC_ASSERT(std::string(error.what()).find("both fit the truth") != std::string::npos);
    }
  }));
}

/// One who goes in circles turns enough to tell, however the rig is mounted.
TEST_F(ScoreInputTest, OneWhoTurnsIsReadInEitherOrder) {
  EXPECT_TRUE(rc::check([this] {
    const Trajectory truth = Circle(AnyPose().linear());
    const std::string file = Write("truth.txt", FormatTrajectory(truth, TrajectoryFormat::kTum));
    for (const Order order : {Order::kFirst, Order::kLast}) {
      const PosesRead read =
          ReadPoseFiles({.truth = file, .estimates = {Write("e.txt", Rows(truth, order))}})
              .estimates.front();
      RC_ASSERT(LargestTurnDeg(read.poses, truth) < 1e-6);
      RC_ASSERT(read.format == (order == Order::kFirst ? "EuRoC, qw first" : "TUM, qw last"));
    }
  }));
}

TEST_F(ScoreInputTest, AFormatOfItsOwnIsTakenAtItsWord) {
  const Trajectory poses = Circle(Eigen::Matrix3d::Identity());
  const std::string truth = Write("truth.txt", FormatTrajectory(poses, TrajectoryFormat::kEuroc));
  const std::string estimate = Write("e.txt", Rows(poses, Order::kLast));
  const AllPosesRead read =
      ReadPoseFiles({.truth = truth, .estimates = {estimate}, .format_estimate = "tum"});
  EXPECT_LT(LargestTurnDeg(read.estimates.front().poses, poses), 1e-6);
  EXPECT_EQ(read.truth.format, "EuRoC, qw first");
  EXPECT_EQ(read.estimates.front().note, "");
}

/// `--truth <(...)`: what has been read of a pipe is gone.
TEST_F(ScoreInputTest, APipeIsReadOnce) {
  const Trajectory poses = Circle(Eigen::Matrix3d::Identity());
  std::vector<std::thread> writers;
  const auto pipe = [&](const std::string& name, const std::string& text) {
    const std::string file = (folder_ / name).string();
    fs::create_directories(folder_);
    EXPECT_EQ(::mkfifo(file.c_str(), 0600), 0);
    writers.emplace_back([=] {
      const int end = ::open(file.c_str(), O_WRONLY);
      EXPECT_EQ(::write(end, text.data(), text.size()), static_cast<ssize_t>(text.size()));
      ::close(end);
    });
    return file;
  };
  std::string times;
  for (const StampedPose& pose : poses) times += FormatSeconds(pose.stamp_ns) + "\n";
  const PoseFiles files{
      .truth = pipe("truth", FormatTrajectory(poses, TrajectoryFormat::kTum)),
      .estimates = {pipe("a", Rows(poses, Order::kFirst)),
                    pipe("b", FormatTrajectory(poses, TrajectoryFormat::kKitti)),
                    Write("c", FormatTrajectory(poses, TrajectoryFormat::kKitti))},
      .times = pipe("times", times)};
  const AllPosesRead read = ReadPoseFiles(files);
  for (std::thread& writer : writers) writer.join();
  EXPECT_EQ(read.truth.poses.size(), poses.size());
  for (const PosesRead& estimate : read.estimates) {
    ASSERT_EQ(estimate.poses.size(), poses.size());
    EXPECT_LT(LargestTurnDeg(estimate.poses, poses), 1e-6);
    EXPECT_EQ(estimate.poses.back().stamp_ns, poses.back().stamp_ns);
  }
}

TEST_F(ScoreInputTest, ATruthThatDoesNotTellIsAskedFor) {
  const std::string truth = Write("t.txt", "1403636579763555584 0 0 0 1 0 0 0\n");
  try {
    ReadPoseFiles({.truth = truth, .estimates = {truth}});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("--format-truth euroc (first) or --format-truth "
                                                 "tum (last)"));
  }
}

}  // namespace
}  // namespace aisle
