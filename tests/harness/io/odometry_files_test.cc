#include "harness/io/odometry_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "harness/io/file.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kStepNs = 50'000'000;

Eigen::Isometry3d Pose(double ahead_m, double turn_rad) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitY()).toRotationMatrix();
  pose.translation() << 0.2 * turn_rad, 0, ahead_m;
  return pose;
}

/// Frames of a way that began somewhere else, turned.
std::vector<FrameRequest> Frames() {
  const Eigen::Isometry3d T_world_first = Pose(-7, 2);
  std::vector<FrameRequest> frames;
  for (int i = 0; i < 6; ++i) {
    frames.push_back({i, kStepNs * (i + 3), T_world_first * Pose(0.05 * i, 0.02 * i * i)});
  }
  return frames;
}

WheelMotions TrueMotions(const std::vector<FrameRequest>& frames) {
  WheelMotions motions;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    motions.push_back(
        MotionMeasurement{frames[i].T_world_rig.inverse() * frames[i - 1].T_world_rig});
  }
  return motions;
}

TEST(JoinMotionsTest, TrueMotionsMakeTheWayFromTheFirstFrameOn) {
  const std::vector<FrameRequest> frames = Frames();
  const Trajectory track = JoinMotions(frames, TrueMotions(frames));
  ASSERT_EQ(track.size(), frames.size());
  for (std::size_t i = 0; i < track.size(); ++i) {
    EXPECT_EQ(track[i].stamp_ns, frames[i].stamp_ns);
    EXPECT_TRUE(
        (frames[0].T_world_rig * track[i].T_world_rig).isApprox(frames[i].T_world_rig, 1e-12));
  }
  EXPECT_THROW(JoinMotions(frames, {}), std::invalid_argument);
}

TEST(WriteOdometryTest, EveryFormatReadsBack) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("aisle_odom_{}", ::getpid());
  const std::vector<FrameRequest> frames = Frames();
  const Trajectory track = JoinMotions(frames, TrueMotions(frames));
  const auto written = [&](DatasetFormat format, const char* file, TrajectoryFormat rows) {
    WriteOdometry(folder, track, {.format = format});
    return ReadTrajectory(folder / file, rows);
  };
  const Trajectory euroc =
      written(DatasetFormat::kEuroc, "mav0/odom0/data.csv", TrajectoryFormat::kEuroc);
  const Trajectory kitti =
      written(DatasetFormat::kKitti, "sequences/00/odometry.txt", TrajectoryFormat::kKitti);
  const Trajectory tum = written(DatasetFormat::kTum, "odometry.txt", TrajectoryFormat::kTum);
  for (const Trajectory* read : {&euroc, &kitti, &tum}) {
    ASSERT_EQ(read->size(), track.size());
    for (std::size_t i = 0; i < track.size(); ++i) {
      EXPECT_TRUE((*read)[i].T_world_rig.isApprox(track[i].T_world_rig, 1e-12));
    }
  }
  const std::int64_t epoch_ns = ExportOptions().epoch_ns;  // as the images' own stamps
  EXPECT_EQ(euroc.front().stamp_ns, track.front().stamp_ns + epoch_ns);
  EXPECT_EQ(tum.back().stamp_ns, track.back().stamp_ns + epoch_ns);
  EXPECT_THAT(ReadFile(folder / "mav0/odom0/sensor.yaml"),
              testing::HasSubstr("sensor_type: odometry"));
  RemoveFolder(folder);
}

}  // namespace
}  // namespace aisle
