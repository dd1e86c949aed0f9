#include "harness/vehicle/odometry.h"

#include "harness/common/mix.h"

namespace aisle {
namespace {

/// Uniform in (0, 1), from its content alone.
double Uniform(std::uint64_t seed, std::uint64_t step, std::uint64_t stream) {
  const std::uint64_t z = Mix(Mix(Mix(seed + kGolden) + step * kGolden) + stream * kGolden);
  return (static_cast<double>(z >> 11) + 0.5) * 0x1.0p-53;
}

double Normal(std::uint64_t seed, std::uint64_t step, std::uint64_t stream) {
  return std::sqrt(-2 * std::log(Uniform(seed, step, 2 * stream))) *
         std::cos(2 * std::numbers::pi * Uniform(seed, step, 2 * stream + 1));
}

// Streams of the run's own numbers; wheels are 0 and 1.
constexpr std::uint64_t kRadius = 10, kInequality = 11, kBase = 12, kSteering = 13;

}  // namespace

Odometer::Odometer(const OdometryOptions& options, const PlantOptions& plant, std::uint64_t seed)
    : options_(options),
      plant_(plant),
      seed_(seed),
      radius_(options.radius_error * Normal(seed, 0, kRadius)),
      inequality_(options.inequality * Normal(seed, 0, kInequality)),
      base_(options.track_error * Normal(seed, 0, kBase)),
      steering_(options.steering_error_rad * Normal(seed, 0, kSteering)) {}

double Odometer::Counted(double way_m, double error, double acceleration, int wheel) {
  const double share = 1 + error + options_.slip_per_mps2 * acceleration;
  const double noise = std::sqrt(options_.noise_m * std::abs(way_m)) *
                       Normal(seed_, step_, static_cast<std::uint64_t>(wheel));
  way_m_[wheel] += way_m * share + noise;
  const double count_m = 2 * std::numbers::pi * options_.wheel_radius_m / options_.counts_per_rev;
  const auto counts = static_cast<std::int64_t>(std::floor(way_m_[wheel] / count_m));
  const std::int64_t more = counts - counts_[wheel];
  counts_[wheel] = counts;
  return static_cast<double>(more) * count_m;
}

FloorPose Odometer::Measure(const PlantStep& step) {
  ++step_;
  const double speed_up =
      step.way_m < 0 ? -step.state.acceleration_mps2 : step.state.acceleration_mps2;
  double way = 0, turn = 0;
  if (plant_.kind == VehicleKind::kTricycle) {
    const double wheel = Counted(step.wheel_way_m, radius_, speed_up, 0);
    const double angle = step.steering_rad + steering_;
    way = wheel * std::cos(angle);
    turn = wheel * std::sin(angle) / (plant_.wheelbase_m * (1 + base_));
  } else {
    const double half_turn = step.turn_rad * plant_.track_m / 2;
    const double left = Counted(step.way_m - half_turn, radius_ - inequality_ / 2, speed_up, 0);
    const double right = Counted(step.way_m + half_turn, radius_ + inequality_ / 2, speed_up, 1);
    way = (left + right) / 2;
    turn = (right - left) / (plant_.track_m * (1 + base_));
  }
  return AlongArc({}, way, turn);
}

}  // namespace aisle
