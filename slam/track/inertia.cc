#include "slam/track/inertia.h"

#include <Eigen/Cholesky>

namespace aisle::slam {

MeasuredMotion Carry(const Velocity& velocity, double seconds, const InertiaOptions& options) {
  return {Retract(Eigen::Isometry3d::Identity(), velocity.per_second * seconds),
          seconds * seconds * Coasted(velocity, seconds, options).covariance};
}

Velocity Coasted(const Velocity& velocity, double seconds, const InertiaOptions& options) {
  Vector6d deviation;
  deviation << Eigen::Vector3d::Constant(options.acceleration_mps2 * seconds),
      Eigen::Vector3d::Constant(options.angular_acceleration_radps2 * seconds);
  Velocity coasted = velocity;
  coasted.covariance += deviation.cwiseAbs2().asDiagonal();
  return coasted;
}

Velocity Learn(const std::optional<Velocity>& before, const MeasuredMotion& step, double seconds,
               const InertiaOptions& options) {
  const Velocity seen{Difference(Eigen::Isometry3d::Identity(), step.T_now_before) / seconds,
                      step.covariance / (seconds * seconds)};
  if (!before) return seen;
  Velocity velocity = Coasted(*before, seconds, options);
  const Vector6d off = seen.per_second - velocity.per_second;
  const auto sum = (velocity.covariance + seen.covariance).ldlt();
  if (off.dot(sum.solve(off)) > options.most_chi2) return velocity;
  const Matrix6d gain = sum.solve(velocity.covariance).transpose();
  velocity.per_second += gain * off;
  velocity.covariance -= gain * velocity.covariance;
  velocity.covariance = 0.5 * (velocity.covariance + velocity.covariance.transpose()).eval();
  return velocity;
}

}  // namespace aisle::slam
