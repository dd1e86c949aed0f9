#include "harness/plugs/wheel_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace aisle {
namespace {

constexpr std::int64_t kSilenceNs = 250'000'000;  ///< longer than this nobody evens out

slam::Matrix6d Symmetric(const slam::Matrix6d& matrix) { return (matrix + matrix.transpose()) / 2; }

/// Where a stamp lies among the poses: behind number `after - 1` by a share of the step to `after`.
struct Place {
  std::size_t after = 0;
  double share = 0;  ///< in [0, 1]
};

class RecordedWheels {
 public:
  explicit RecordedWheels(const WheelTrack& track) : track_(track) {}

  std::optional<Place> At(std::int64_t stamp_ns) const {
    const Trajectory& poses = track_.poses;
    const auto at = std::ranges::lower_bound(poses, stamp_ns, {}, &StampedPose::stamp_ns);
    if (at == poses.end()) return std::nullopt;
    const auto after = static_cast<std::size_t>(at - poses.begin());
    if (at->stamp_ns == stamp_ns) return Place{after, 1};
    if (after == 0) return std::nullopt;
    const std::int64_t before_ns = poses[after - 1].stamp_ns, step_ns = at->stamp_ns - before_ns;
    if (step_ns > kSilenceNs) return std::nullopt;
    return Place{after, static_cast<double>(stamp_ns - before_ns) / static_cast<double>(step_ns)};
  }

  /// Of base_link. Nothing where the wheels were silent between.
  std::optional<MotionMeasurement> Between(const Place& from, const Place& to) const {
    const Eigen::Isometry3d T_now_odom = Pose(to).inverse();
    MotionMeasurement motion{T_now_odom * Pose(from), slam::Matrix6d::Zero()};
    double way_m = 0, turn_rad = 0;
    for (std::size_t step = from.after; step <= to.after; ++step) {
      const double share =
          (step == to.after ? to.share : 1) - (step == from.after ? from.share : 0);
      if (share <= 0) continue;
      if (StepNs(step) > kSilenceNs) return std::nullopt;
      const slam::Vector6d moved = Moved(step);
      way_m += share * moved.head<3>().norm();
      turn_rad += share * moved.tail<3>().norm();
      if (track_.covariances.empty()) continue;
      const slam::Matrix6d carry = slam::Adjoint(T_now_odom * track_.poses[step].T_world_rig);
      motion.covariance += share * (carry * track_.covariances[step] * carry.transpose());
    }
    if (track_.covariances.empty()) {
      motion.covariance = RollingCovariance(way_m, turn_rad, {}, {});
    }
    return motion;
  }

 private:
  std::int64_t StepNs(std::size_t step) const {
    return track_.poses[step].stamp_ns - track_.poses[step - 1].stamp_ns;
  }
  /// Of base_link in its own frame at the step's beginning.
  slam::Vector6d Moved(std::size_t step) const {
    return slam::Difference(
        Eigen::Isometry3d::Identity(),
        track_.poses[step - 1].T_world_rig.inverse() * track_.poses[step].T_world_rig);
  }
  Eigen::Isometry3d Pose(const Place& place) const {
    if (place.share >= 1) return track_.poses[place.after].T_world_rig;
    return track_.poses[place.after - 1].T_world_rig *
           slam::Retract(Eigen::Isometry3d::Identity(), place.share * Moved(place.after));
  }

  const WheelTrack& track_;
};

constexpr double kFresh_m = 5, kFresh_rad = 3;  // a calibration's error as if drawn anew

double Squared(double x) { return x * x; }

/// Variances of what wheels make of a motion.
struct Rolled {
  double ahead_m2 = 0, heading_rad2 = 0;
};

/// Of counting in whole steps, at both ends.
double CountingVariance(const OdometryOptions& options) {
  return Squared(2 * std::numbers::pi * options.wheel_radius_m / options.counts_per_rev) / 6;
}

Rolled RolledByDifferential(double way_m, double turn_rad, const OdometryOptions& options,
                            const PlantOptions& plant) {
  const double of_wheel = options.noise_m * way_m + CountingVariance(options);
  return {Squared(options.radius_error) * kFresh_m * way_m + of_wheel,
          Squared(options.track_error) * kFresh_rad * turn_rad +
              Squared(options.inequality / plant.track_m) * kFresh_m * way_m +
              2 * of_wheel / Squared(plant.track_m)};
}

/// Of one driven wheel, which rolls w and is steered by delta: ahead w cos(delta), turned
/// w sin(delta) / wheelbase. An error of the steering's zero turns the way into heading, and where
/// it turns, into way.
Rolled RolledByTricycle(double way_m, double turn_rad, const OdometryOptions& options,
                        const PlantOptions& plant) {
  const double across_m = plant.wheelbase_m * turn_rad, wheel_m = std::hypot(way_m, across_m);
  const double ahead = wheel_m > 0 ? way_m / wheel_m : 1;     // cos(delta)
  const double aside = wheel_m > 0 ? across_m / wheel_m : 0;  // sin(delta)
  const double of_noise = options.noise_m * wheel_m, of_counts = CountingVariance(options);
  return {
      Squared(options.radius_error) * kFresh_m * way_m +
          Squared(options.steering_error_rad * plant.wheelbase_m) * kFresh_rad * turn_rad +
          of_noise * Squared(ahead) + of_counts,
      Squared(options.steering_error_rad / plant.wheelbase_m) * kFresh_m * way_m +
          (Squared(options.radius_error) + Squared(options.track_error)) * kFresh_rad * turn_rad +
          (of_noise * Squared(aside) + of_counts) / Squared(plant.wheelbase_m)};
}

}  // namespace

slam::Matrix6d RollingCovariance(double way_m, double turn_rad, const OdometryOptions& options,
                                 const PlantOptions& plant) {
  // Of what wheels do not see: the body heaves, nods and slips aside on an uneven floor.
  constexpr double kUneven_m = 0.002, kUneven_rad = 0.002, kAside_m = 0.0005;
  const double way = std::abs(way_m), turn = std::abs(turn_rad);
  const Rolled rolled = plant.kind == VehicleKind::kTricycle
                            ? RolledByTricycle(way, turn, options, plant)
                            : RolledByDifferential(way, turn, options, plant);
  slam::Vector6d variances;
  variances << rolled.ahead_m2, Squared(kAside_m), Squared(kUneven_m), Squared(kUneven_rad),
      Squared(kUneven_rad), rolled.heading_rad2;
  return variances.asDiagonal();
}

MotionMeasurement OfRig(const MotionMeasurement& of_body, const Eigen::Isometry3d& T_body_rig) {
  const slam::Matrix6d to_rig = slam::Adjoint(T_body_rig.inverse());
  return {T_body_rig.inverse() * of_body.T_now_before * T_body_rig,
          Symmetric(to_rig * of_body.covariance * to_rig.transpose())};
}

OdometryReading Reckon(const OdometryReading& before, const MotionMeasurement& of_body,
                       double seconds) {
  // A pose's error along the axes of odom is that of a small motion of the body, turned.
  const auto turned = [](const Eigen::Matrix3d& R, const slam::Matrix6d& covariance) {
    slam::Matrix6d turn = slam::Matrix6d::Zero();
    turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = R;
    return Symmetric(turn * covariance * turn.transpose());
  };
  const Eigen::Isometry3d T_before_now = of_body.T_now_before.inverse();
  const slam::Matrix6d carry = slam::Adjoint(of_body.T_now_before);
  OdometryReading now;
  now.T_odom_base = slam::Normalized(before.T_odom_base * T_before_now);
  now.twist = slam::Difference(Eigen::Isometry3d::Identity(), T_before_now) / seconds;
  now.twist_covariance = of_body.covariance / (seconds * seconds);
  const slam::Matrix6d of_body_before =
      turned(before.T_odom_base.linear().transpose(), before.covariance);
  now.covariance = turned(now.T_odom_base.linear(),
                          carry * of_body_before * carry.transpose() + of_body.covariance);
  return now;
}

WheelMotions MotionsBetween(const WheelTrack& track, const std::vector<std::int64_t>& stamps_ns,
                            const Eigen::Isometry3d& T_left_rig) {
  const RecordedWheels wheels(track);
  const Eigen::Isometry3d T_base_rig = track.T_base_left * T_left_rig;
  WheelMotions motions;
  std::optional<Place> before;
  for (std::size_t i = 0; i < stamps_ns.size(); ++i) {
    const std::optional<Place> now = wheels.At(stamps_ns[i]);
    if (i > 0) {
      const auto moved = before && now ? wheels.Between(*before, *now) : std::nullopt;
      motions.push_back(moved ? std::optional(OfRig(*moved, T_base_rig)) : std::nullopt);
    }
    before = now;
  }
  return motions;
}

}  // namespace aisle
