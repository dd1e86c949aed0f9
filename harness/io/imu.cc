#include "harness/io/imu.h"

namespace aisle {
namespace {

constexpr std::int64_t kStepNs = 1'000'000;
constexpr double kStepS = 1e-3;

ImuSample SampleAt(const std::function<Eigen::Isometry3d(std::int64_t)>& path,
                   std::int64_t stamp_ns) {
  const Eigen::Isometry3d before = path(stamp_ns - kStepNs), now = path(stamp_ns),
                          after = path(stamp_ns + kStepNs);
  const Eigen::AngleAxisd turn(before.linear().transpose() * after.linear());
  const Eigen::Vector3d acceleration =
      (after.translation() - 2 * now.translation() + before.translation()) / (kStepS * kStepS);
  const Eigen::Vector3d gravity(0, 0, -kGravityMps2);
  // The turn over two steps, seen from the middle: its axis is the same in both frames' mean.
  return {.stamp_ns = stamp_ns,
          .angular_velocity = turn.axis() * turn.angle() / (2 * kStepS),
          .specific_force = now.linear().transpose() * (acceleration - gravity)};
}

}  // namespace

std::vector<ImuSample> IdealImu(const std::function<Eigen::Isometry3d(std::int64_t)>& path,
                                std::int64_t first_ns, std::int64_t last_ns, double rate_hz) {
  const auto step_ns = static_cast<std::int64_t>(std::llround(1e9 / rate_hz));
  std::vector<ImuSample> samples;
  for (std::int64_t t = first_ns; t <= last_ns; t += step_ns) samples.push_back(SampleAt(path, t));
  return samples;
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
