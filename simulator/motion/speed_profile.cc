#include "simulator/motion/speed_profile.h"

#include <algorithm>
#include <cmath>
#include <limits>
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

/// Every limit reaches as far beyond its stretch, either way, as it lets the mover go in `span_s`.
/// So an average of trapezoids over twice that time has the limit's speed by where the stretch
/// begins, and until where it ends.
std::vector<SpeedLimit> Widened(std::span<const SpeedLimit> limits, double span_s) {
  struct Zone {
    double from_m, to_m, speed_mps;
  };
  std::vector<Zone> zones;
  std::vector<double> joints = {0};
  double length = 0;
  for (const SpeedLimit& limit : limits) {
    const double reach = limit.speed_mps * span_s;
    zones.push_back({length - reach, length + limit.length_m + reach, limit.speed_mps});
    length += limit.length_m;
    joints.insert(joints.end(), {zones.back().from_m, zones.back().to_m});
  }
  joints.push_back(length);
  for (double& joint : joints) joint = std::clamp(joint, 0.0, length);
  std::ranges::sort(joints);
  std::vector<SpeedLimit> widened;
  for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
    if (joints[i + 1] <= joints[i]) continue;
    const double middle = (joints[i] + joints[i + 1]) / 2;
    double speed = std::numeric_limits<double>::infinity();
    for (const Zone& zone : zones) {
      if (zone.from_m <= middle && middle <= zone.to_m) speed = std::min(speed, zone.speed_mps);
    }
    widened.push_back({joints[i + 1] - joints[i], speed});
  }
  return widened;
}

}  // namespace

void SpeedProfile::Append(double from, double to, double length, double acceleration) {
  if (length <= 0) return;
  // Constant acceleration covers `length` at the mean of the two speeds.
  const double duration = 2 * length / (from + to);
  phases_.push_back({duration_s_, duration, {length_m_, from, acceleration}, 0});
  duration_s_ += duration;
  length_m_ += length;
}

SpeedProfile SpeedProfile::Trapezoids(std::span<const SpeedLimit> limits, double acceleration) {
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

/// Speed averaged over a window in time; it begins half a window earlier and ends as much later.
/// Its acceleration is the difference of the speeds at the window's ends, linear between the times
/// at which either end passes from one phase to the next.
SpeedProfile SpeedProfile::AveragedOver(double window_s) const {
  std::vector<double> knots;
  for (const Phase& phase : phases_) {
    knots.insert(knots.end(), {phase.start_s, phase.start_s + window_s});
  }
  knots.insert(knots.end(), {duration_s_, duration_s_ + window_s});
  std::ranges::sort(knots);
  const auto acceleration = [&](double time) {
    return (At(time).speed_mps - At(time - window_s).speed_mps) / window_s;
  };
  SpeedProfile averaged;
  Travel now;
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const double duration = knots[i + 1] - knots[i];
    if (duration <= 0) continue;
    now.acceleration_mps2 = acceleration(knots[i]);
    const double gained = acceleration(knots[i + 1]) - now.acceleration_mps2;
    averaged.phases_.push_back({knots[i], duration, now, gained / duration});
    now.distance_m +=
        (now.speed_mps + (now.acceleration_mps2 / 2 + gained / 6) * duration) * duration;
    now.speed_mps += (now.acceleration_mps2 + gained / 2) * duration;
  }
  averaged.duration_s_ = duration_s_ + window_s;
  averaged.length_m_ = length_m_;
  return averaged;
}

SpeedProfile SpeedProfile::FromRestToRest(std::span<const SpeedLimit> limits, double acceleration,
                                          double jerk) {
  const bool sound =
      acceleration > 0 && jerk > 0 && std::ranges::all_of(limits, [](const SpeedLimit& limit) {
        return limit.length_m > 0 && limit.speed_mps > 0;
      });
  if (!sound) throw std::invalid_argument("a speed profile needs positive lengths and speeds");
  if (limits.empty() || !std::isfinite(jerk)) return Trapezoids(limits, acceleration);
  const double window_s = 2 * acceleration / jerk;
  return Trapezoids(Widened(limits, window_s / 2), acceleration).AveragedOver(window_s);
}

SpeedProfile SpeedProfile::Paced(double from_mps, std::span<const Stretch> stretches) {
  SpeedProfile profile;
  double speed = from_mps;
  for (const Stretch& stretch : stretches) {
    if (!(stretch.duration_s > 0)) throw std::invalid_argument("a paced stretch takes no time");
    const double acceleration = (stretch.to_mps - speed) / stretch.duration_s;
    profile.phases_.push_back(
        {profile.duration_s_, stretch.duration_s, {profile.length_m_, speed, acceleration}, 0});
    profile.length_m_ += (speed + stretch.to_mps) / 2 * stretch.duration_s;
    profile.duration_s_ += stretch.duration_s;
    speed = stretch.to_mps;
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
  const double jerk = phase.jerk_mps3;
  return {distance + (speed + (acceleration + jerk * elapsed / 3) * elapsed / 2) * elapsed,
          speed + (acceleration + jerk * elapsed / 2) * elapsed, acceleration + jerk * elapsed};
}

}  // namespace aisle::sim
