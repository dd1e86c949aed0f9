#include "simulator/motion/speed_profile.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace aisle::sim {
namespace {

/// Speeds at the joints between stretches: no higher than both neighbours allow, and reachable from
/// rest at either end.
std::vector<double> JointSpeeds(std::span<const SpeedLimit> limits, double acceleration) {
  std::vector<double> speeds(limits.size() + 1, 0.0);
  for (std::size_t i = 1; i < limits.size(); ++i) {
    speeds[i] = std::min(limits[i - 1].speed_mps, limits[i].speed_mps);
  }
  const auto reachable = [&](double from, double length) {
    return std::sqrt(from * from + 2 * acceleration * length);
  };
  for (std::size_t i = 0; i < limits.size(); ++i) {
    speeds[i + 1] = std::min(speeds[i + 1], reachable(speeds[i], limits[i].length_m));
  }
  for (std::size_t i = limits.size(); i-- > 0;) {
    speeds[i] = std::min(speeds[i], reachable(speeds[i + 1], limits[i].length_m));
  }
  return speeds;
}

}  // namespace

void SpeedProfile::Append(double from, double to, double length, double acceleration) {
  if (length <= 0) return;
  // Constant acceleration covers `length` at the mean of the two speeds.
  const double duration = 2 * length / (from + to);
  phases_.push_back({duration_s_, duration, {length_m_, from, acceleration}});
  duration_s_ += duration;
  length_m_ += length;
}

SpeedProfile SpeedProfile::FromRestToRest(std::span<const SpeedLimit> limits, double acceleration) {
  const bool sound = acceleration > 0 && std::ranges::all_of(limits, [](const SpeedLimit& limit) {
                       return limit.length_m > 0 && limit.speed_mps > 0;
                     });
  if (!sound) throw std::invalid_argument("a speed profile needs positive lengths and speeds");
  const std::vector<double> joints = JointSpeeds(limits, acceleration);
  SpeedProfile profile;
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const double length = limits[i].length_m, from = joints[i], to = joints[i + 1];
    // The speed at which speeding up from one end meets slowing down to the other.
    const double meeting = std::sqrt(acceleration * length + (from * from + to * to) / 2);
    const double top = std::min(limits[i].speed_mps, meeting);
    const double up = std::max(0.0, (top * top - from * from) / (2 * acceleration));
    const double down = std::max(0.0, (top * top - to * to) / (2 * acceleration));
    profile.Append(from, top, up, acceleration);
    profile.Append(top, top, std::max(0.0, length - up - down), 0);
    profile.Append(top, to, down, -acceleration);
  }
  return profile;
}

Travel SpeedProfile::At(double time_s) const {
  if (phases_.empty() || time_s <= 0) return {};
  if (time_s >= duration_s_) return {length_m_, 0, 0};
  const auto after =
      std::upper_bound(phases_.begin() + 1, phases_.end(), time_s,
                       [](double time, const Phase& phase) { return time < phase.start_s; });
  const Phase& phase = *std::prev(after);
  const double elapsed = time_s - phase.start_s;
  const auto& [distance, speed, acceleration] = phase.start;
  return {distance + (speed + acceleration * elapsed / 2) * elapsed, speed + acceleration * elapsed,
          acceleration};
}

}  // namespace aisle::sim
