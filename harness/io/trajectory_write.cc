#include "harness/common/seconds.h"
#include "harness/io/trajectory.h"

namespace aisle {
namespace {

std::string TumLine(const StampedPose& pose) {
  const Eigen::Vector3d p = pose.T_world_rig.translation();
  const Eigen::Quaterniond q(pose.T_world_rig.linear());
  return fmt::format("{} {} {} {} {} {} {} {}\n", FormatSeconds(pose.stamp_ns), p.x(), p.y(), p.z(),
                     q.x(), q.y(), q.z(), q.w());
}

std::string KittiLine(const StampedPose& pose) {
  const Eigen::Matrix4d m = pose.T_world_rig.matrix();
  std::string line;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      line += fmt::format("{}{}", line.empty() ? "" : " ", m(row, column));
    }
  }
  return line + "\n";
}

/// By differences over the neighbours, one-sided at the ends; 0 for a single pose.
Eigen::Vector3d VelocityMps(const Trajectory& trajectory, std::size_t i) {
  const StampedPose& before = trajectory[i == 0 ? 0 : i - 1];
  const StampedPose& after = trajectory[std::min(i + 1, trajectory.size() - 1)];
  const double seconds = ToSeconds(after.stamp_ns - before.stamp_ns);
  if (seconds <= 0) return Eigen::Vector3d::Zero();
  return (after.T_world_rig.translation() - before.T_world_rig.translation()) / seconds;
}

constexpr const char* kEurocHeader =
    "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], "
    "q_RS_z [], v_RS_R_x [m s^-1], v_RS_R_y [m s^-1], v_RS_R_z [m s^-1], b_w_RS_S_x [rad s^-1], "
    "b_w_RS_S_y [rad s^-1], b_w_RS_S_z [rad s^-1], b_a_RS_S_x [m s^-2], b_a_RS_S_y [m s^-2], "
    "b_a_RS_S_z [m s^-2]\n";

std::string EurocLine(const StampedPose& stamped, const Eigen::Vector3d& v) {
  const Eigen::Vector3d p = stamped.T_world_rig.translation();
  const Eigen::Quaterniond q(stamped.T_world_rig.linear());
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{},0,0,0,0,0,0\n", stamped.stamp_ns, p.x(),
                     p.y(), p.z(), q.w(), q.x(), q.y(), q.z(), v.x(), v.y(), v.z());
}

}  // namespace

std::string FormatTrajectory(const Trajectory& trajectory, TrajectoryFormat format) {
  std::string text;
  if (format == TrajectoryFormat::kTum) text = "# timestamp tx ty tz qx qy qz qw\n";
  if (format == TrajectoryFormat::kEuroc) text = kEurocHeader;
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    switch (format) {
      case TrajectoryFormat::kTum:
        text += TumLine(trajectory[i]);
        break;
      case TrajectoryFormat::kKitti:
        text += KittiLine(trajectory[i]);
        break;
      case TrajectoryFormat::kEuroc:
        text += EurocLine(trajectory[i], VelocityMps(trajectory, i));
        break;
    }
  }
  return text;
}

std::string FormatEurocTruth(const Trajectory& trajectory,
                             const std::vector<Eigen::Vector3d>& velocities_mps) {
  std::string text = kEurocHeader;
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    text += EurocLine(trajectory[i], velocities_mps.at(i));
  }
  return text;
}

}  // namespace aisle
