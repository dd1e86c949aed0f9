#include "harness/io/imu.h"

#include "harness/common/seconds.h"

namespace aisle {
namespace {

using PoseAt = std::function<Eigen::Isometry3d(std::int64_t)>;

std::int64_t StepNs(double rate_hz) {
  return static_cast<std::int64_t>(std::llround(1e9 / rate_hz));
}

/// What the rotation turns by between two poses, in either's axes: rad.
Eigen::Vector3d Turn(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) {
  const Eigen::AngleAxisd turn(from.linear().transpose() * to.linear());
  return turn.axis() * turn.angle();
}

/// Twice the mean over one interval less the mean over two, both about the stamp. Trapezoids over
/// such samples add up to (4 (R(t+d/2) + R(t-d/2)) - R(t+d) - 2 R(t) - R(t-d)) / 4 for a turn about
/// one axis, which is R(t) but for terms of the fourth order.
Eigen::Vector3d AngularVelocity(const PoseAt& path, std::int64_t stamp_ns, std::int64_t step_ns) {
  const std::int64_t half_ns = step_ns / 2;
  const Eigen::Vector3d near = Turn(path(stamp_ns - half_ns), path(stamp_ns + half_ns));
  const Eigen::Vector3d far = Turn(path(stamp_ns - step_ns), path(stamp_ns + step_ns));
  return 2 * near / (2e-9 * static_cast<double>(half_ns)) -
         far / (2e-9 * static_cast<double>(step_ns));
}

/// Trapezoids over such samples add up to the velocity by central differences of the fourth order.
Eigen::Vector3d Acceleration(const PoseAt& path, std::int64_t stamp_ns, std::int64_t step_ns) {
  const auto at = [&](int steps) -> Eigen::Vector3d {
    return path(stamp_ns + steps * step_ns).translation();
  };
  const double step_s = ToSeconds(step_ns);
  return (10 * (at(1) + at(-1)) - 18 * at(0) - at(2) - at(-2)) / (6 * step_s * step_s);
}

ImuSample SampleAt(const PoseAt& path, std::int64_t stamp_ns, std::int64_t step_ns) {
  const Eigen::Vector3d gravity(0, 0, -kGravityMps2);
  return {.stamp_ns = stamp_ns,
          .angular_velocity = AngularVelocity(path, stamp_ns, step_ns),
          .specific_force = path(stamp_ns).linear().transpose() *
                            (Acceleration(path, stamp_ns, step_ns) - gravity)};
}

}  // namespace

std::vector<ImuSample> IdealImu(const std::function<Eigen::Isometry3d(std::int64_t)>& path,
                                std::int64_t first_ns, std::int64_t last_ns, double rate_hz) {
  const std::int64_t step_ns = StepNs(rate_hz);
  std::vector<ImuSample> samples;
  for (std::int64_t t = first_ns; t <= last_ns; t += step_ns) {
    samples.push_back(SampleAt(path, t, step_ns));
  }
  return samples;
}

Eigen::Vector3d VelocityAt(const std::function<Eigen::Isometry3d(std::int64_t)>& path,
                           std::int64_t stamp_ns, double rate_hz) {
  const std::int64_t step_ns = StepNs(rate_hz);
  const auto across = [&](std::int64_t steps) -> Eigen::Vector3d {
    return path(stamp_ns + steps * step_ns).translation() -
           path(stamp_ns - steps * step_ns).translation();
  };
  return (8 * across(1) - across(2)) / (12e-9 * static_cast<double>(step_ns));
}

std::string FormatEurocImu(const std::vector<ImuSample>& samples, std::int64_t epoch_ns) {
  std::string text =
      "#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],"
      "a_RS_S_x [m s^-2],a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]\n";
  for (const ImuSample& sample : samples) {
    const Eigen::Vector3d &w = sample.angular_velocity, &a = sample.specific_force;
    text += fmt::format("{},{},{},{},{},{},{}\n", sample.stamp_ns + epoch_ns, w.x(), w.y(), w.z(),
                        a.x(), a.y(), a.z());
  }
  return text;
}

}  // namespace aisle
