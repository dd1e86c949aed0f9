#include "harness/io/odometry_files.h"

#include <stdexcept>

#include "harness/io/file.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

constexpr const char* kEurocSensor =
    "%YAML 1.0\n---\nsensor_type: odometry\n"
    "comment: what the vehicle's wheels make of its way, as poses of the body from the first image "
    "on; it drifts\n"
    "T_BS:\n  cols: 4\n  rows: 4\n"
    "  data: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\n";

std::string EurocRows(const Trajectory& track) {
  std::string text = "#timestamp [ns],p_x [m],p_y [m],p_z [m],q_w [],q_x [],q_y [],q_z []\n";
  for (const StampedPose& pose : track) {
    const Eigen::Vector3d& p = pose.T_world_rig.translation();
    const Eigen::Quaterniond q(pose.T_world_rig.linear());
    text += fmt::format("{},{},{},{},{},{},{},{}\n", pose.stamp_ns, p.x(), p.y(), p.z(), q.w(),
                        q.x(), q.y(), q.z());
  }
  return text;
}

/// Of poses of a body in which the left camera stands at T_body_left.
WheelTrack OfBaseAtCamera(const Trajectory& poses, const Eigen::Isometry3d& T_body_left) {
  const Eigen::Isometry3d T_body_base = T_body_left * CameraAhead().inverse();
  WheelTrack track{.poses = poses, .T_base_left = CameraAhead()};
  for (StampedPose& pose : track.poses) pose.T_world_rig = pose.T_world_rig * T_body_base;
  return track;
}

}  // namespace

Trajectory JoinMotions(const std::vector<FrameRequest>& frames, const WheelMotions& motions) {
  if (motions.size() + 1 != frames.size()) {
    throw std::invalid_argument("JoinMotions: a motion for each frame but the first");
  }
  Trajectory track = {{frames.front().stamp_ns, Eigen::Isometry3d::Identity()}};
  for (std::size_t i = 0; i < motions.size(); ++i) {
    if (!motions[i]) {
      throw InputError(
          fmt::format("the wheel odometry has a gap from frame {} to {}: a file of odometry has no "
                      "gaps, but a system with --stream accepts them",
                      i, i + 1));
    }
    track.push_back(
        {frames[i + 1].stamp_ns, track.back().T_world_rig * motions[i]->T_now_before.inverse()});
  }
  return track;
}

void WriteOdometry(const std::filesystem::path& folder, const Trajectory& track,
                   const ExportOptions& options) {
  Trajectory stamped = track;
  for (StampedPose& pose : stamped) pose.stamp_ns += options.epoch_ns;
  switch (options.format) {
    case DatasetFormat::kEuroc:
      WriteFileAtomically(folder / "mav0/odom0/sensor.yaml", kEurocSensor);
      return WriteFileAtomically(folder / "mav0/odom0/data.csv", EurocRows(stamped));
    case DatasetFormat::kKitti:
      return WriteFileAtomically(folder / "sequences/00/odometry.txt",
                                 FormatTrajectory(track, TrajectoryFormat::kKitti));
    case DatasetFormat::kTum:
      return WriteFileAtomically(folder / "odometry.txt",
                                 FormatTrajectory(stamped, TrajectoryFormat::kTum));
  }
}

std::function<WheelTrack()> WheelsOfEuroc(const std::filesystem::path& mav,
                                          const Eigen::Isometry3d& T_body_left) {
  const std::filesystem::path rows = mav / "odom0/data.csv";
  if (!std::filesystem::exists(rows)) return {};
  return
      [=] { return OfBaseAtCamera(ReadTrajectory(rows, TrajectoryFormat::kEuroc), T_body_left); };
}

std::function<WheelTrack()> WheelsOfKitti(const std::filesystem::path& sequence) {
  const std::filesystem::path rows = sequence / "odometry.txt";
  if (!std::filesystem::exists(rows)) return {};
  return [=] {
    return OfBaseAtCamera(ReadTrajectory(rows, TrajectoryFormat::kKitti, sequence / "times.txt"),
                          Eigen::Isometry3d::Identity());
  };
}

}  // namespace aisle
