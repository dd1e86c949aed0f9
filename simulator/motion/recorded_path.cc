#include "simulator/motion/recorded_path.h"

#include <algorithm>
#include <stdexcept>

namespace aisle::sim {
namespace {

constexpr double kNanosecond_s = 1e-9;

Eigen::Vector3d Log(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

Eigen::Matrix3d Exp(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  if (angle < 1e-12) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
}

/// How a rotation vector changes where the body turns at a rate in its own axes: the inverse of the
/// right Jacobian of SO(3) (Chirikjian, Stochastic Models, Information Theory, and Lie Groups 2).
Eigen::Matrix3d InverseRightJacobian(const Eigen::Vector3d& vector) {
  Eigen::Matrix3d skew;
  skew << 0, -vector.z(), vector.y(), vector.z(), 0, -vector.x(), -vector.y(), vector.x(), 0;
  const double angle = vector.norm();
  constexpr double kSmall = 1e-4;
  const double factor =
      angle < kSmall ? 1.0 / 12
                     : 1 / (angle * angle) - (1 + std::cos(angle)) / (2 * angle * std::sin(angle));
  return Eigen::Matrix3d::Identity() + 0.5 * skew + factor * skew * skew;
}

/// The cubic from a to b over `span_s` with the slopes given, at the share `u` of it.
Eigen::Vector3d Hermite(const Eigen::Vector3d& a, const Eigen::Vector3d& slope_a,
                        const Eigen::Vector3d& b, const Eigen::Vector3d& slope_b, double span_s,
                        double u) {
  const double u2 = u * u, u3 = u2 * u;
  return (2 * u3 - 3 * u2 + 1) * a + (u3 - 2 * u2 + u) * span_s * slope_a + (3 * u2 - 2 * u3) * b +
         (u3 - u2) * span_s * slope_b;
}

double Seconds(std::int64_t from_ns, std::int64_t to_ns) {
  return static_cast<double>(to_ns - from_ns) * kNanosecond_s;
}

}  // namespace

RecordedPath::RecordedPath(std::vector<TimedPose> poses) : poses_(std::move(poses)) {
  if (poses_.empty()) throw std::invalid_argument("a path needs a pose");
  const auto does_not_rise = [](const TimedPose& a, const TimedPose& b) {
    return a.time_ns >= b.time_ns;
  };
  if (std::ranges::adjacent_find(poses_, does_not_rise) != poses_.end()) {
    throw std::invalid_argument("times do not rise");
  }
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    // One-sided at the ends.
    const TimedPose& before = poses_[i == 0 ? 0 : i - 1];
    const TimedPose& after = poses_[std::min(i + 1, poses_.size() - 1)];
    const double span_s = Seconds(before.time_ns, after.time_ns);
    const double share = span_s > 0 ? 1 / span_s : 0;
    velocity_mps_.emplace_back(
        (after.T_world_body.translation() - before.T_world_body.translation()) * share);
    turn_rate_rad_s_.emplace_back(
        Log(before.T_world_body.linear().transpose() * after.T_world_body.linear()) * share);
  }
}

Eigen::Isometry3d RecordedPath::Beyond(std::size_t end, std::int64_t time_ns) const {
  const double away_s = Seconds(poses_[end].time_ns, time_ns);
  Eigen::Isometry3d pose = poses_[end].T_world_body;
  pose.translation() += velocity_mps_[end] * away_s;
  pose.linear() = poses_[end].T_world_body.linear() * Exp(turn_rate_rad_s_[end] * away_s);
  return pose;
}

Eigen::Isometry3d RecordedPath::At(std::int64_t time_ns) const {
  const auto after = std::ranges::lower_bound(poses_, time_ns, {}, &TimedPose::time_ns);
  if (after == poses_.end()) return Beyond(poses_.size() - 1, time_ns);
  if (after->time_ns == time_ns) return after->T_world_body;
  if (after == poses_.begin()) return Beyond(0, time_ns);
  const auto k = static_cast<std::size_t>(after - poses_.begin()), i = k - 1;
  const TimedPose &a = poses_[i], &b = poses_[k];
  const double span_s = Seconds(a.time_ns, b.time_ns);
  const double u = Seconds(a.time_ns, time_ns) / span_s;
  const Eigen::Vector3d turn = Log(a.T_world_body.linear().transpose() * b.T_world_body.linear());
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Hermite(a.T_world_body.translation(), velocity_mps_[i],
                               b.T_world_body.translation(), velocity_mps_[k], span_s, u);
  pose.linear() = a.T_world_body.linear() *
                  Exp(Hermite(Eigen::Vector3d::Zero(), turn_rate_rad_s_[i], turn,
                              InverseRightJacobian(turn) * turn_rate_rad_s_[k], span_s, u));
  return pose;
}

}  // namespace aisle::sim
