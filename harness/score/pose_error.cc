#include "harness/score/pose_error.h"

#include <numbers>

namespace aisle {

double RotationAngleDeg(const Eigen::Matrix3d& rotation) {
  // Through the quaternion and atan2: acos of the trace loses half the digits near 0.
  const Eigen::Quaterniond q(rotation);
  return 2 * std::atan2(q.vec().norm(), std::abs(q.w())) * 180 / std::numbers::pi;
}

std::vector<PoseError> AbsoluteErrors(const Trajectory& truth, const Trajectory& estimate,
                                      const std::vector<PosePair>& pairs,
                                      const Alignment& alignment) {
  std::vector<PoseError> errors;
  errors.reserve(pairs.size());
  for (const PosePair& pair : pairs) {
    const Eigen::Isometry3d aligned = Apply(alignment, estimate[pair.estimate].T_world_rig);
    const Eigen::Isometry3d& true_pose = truth[pair.truth].T_world_rig;
    const Eigen::Isometry3d error = aligned.inverse() * true_pose;
    errors.push_back({.pair = pair,
                      .translation_m = (aligned.translation() - true_pose.translation()).norm(),
                      .rotation_deg = RotationAngleDeg(error.linear())});
  }
  return errors;
}

std::vector<double> PathLengthsM(const Trajectory& trajectory) {
  std::vector<double> lengths(trajectory.size(), 0.0);
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    const Eigen::Vector3d step =
        trajectory[i].T_world_rig.translation() - trajectory[i - 1].T_world_rig.translation();
    lengths[i] = lengths[i - 1] + step.norm();
  }
  return lengths;
}

std::vector<double> Translations(const std::vector<PoseError>& errors) {
  std::vector<double> values;
  values.reserve(errors.size());
  for (const PoseError& error : errors) values.push_back(error.translation_m);
  return values;
}

std::vector<double> Rotations(const std::vector<PoseError>& errors) {
  std::vector<double> values;
  values.reserve(errors.size());
  for (const PoseError& error : errors) values.push_back(error.rotation_deg);
  return values;
}

}  // namespace aisle
