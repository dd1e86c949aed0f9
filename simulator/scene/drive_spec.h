#pragma once

#include <Eigen/Core>
#include <numbers>
#include <string>
#include <vector>

#include "simulator/scene/mark.h"

namespace aisle::sim {

/// A rectangle of the floor with a rule for the vehicle: slow, or keep out.
struct ZoneSpec {
  Mark mark;
  std::string name;
  Eigen::Vector2d from = Eigen::Vector2d::Zero(), to = Eigen::Vector2d::Zero();
  double speed_mps = 0;  ///< fastest within; 0: it is not for vehicles
};

enum class DriveKind { kDifferential, kTricycle };
enum class DriverLaw { kPurePursuit, kKanayama };

/// How wheel odometry errs. Systematic parts are drawn once a run, as normal deviates of these
/// widths; see harness/vehicle/odometry.h for the model.
struct OdometrySpec {
  double radius_error = 0.003;        ///< share, of both wheels alike
  double inequality = 0.001;          ///< share, of one wheel against the other
  double track_error = 0.005;         ///< share, of the track width (tricycle: of the wheelbase)
  double steering_error_rad = 0.003;  ///< tricycle: zero of the steering encoder
  double noise_m = 1e-5;              ///< variance a metre of way, m^2/m
  double slip_per_mps2 = 0.004;       ///< share of the way by which a wheel slips, per m/s^2
  int counts_per_rev = 4096;
  double wheel_radius_m = 0.1;
};

/// The vehicle that a scene is driven by in closed loop, and what is asked of it. The rig's route
/// is the planned one, its camera is mounted as the rig says. Angles are radians here.
struct DriveSpec {
  Mark mark;
  bool there = false;  ///< the file has the key: runs of the scene are closed
  DriveKind kind = DriveKind::kDifferential;
  DriverLaw driver = DriverLaw::kPurePursuit;
  /// Corners in the vehicle's frame, x ahead and y left, the origin where the route goes: the
  /// middle of the fixed axle. In order; any simple polygon.
  std::vector<Eigen::Vector2d> footprint = {{-0.3, -0.3}, {0.7, -0.3}, {0.7, 0.3}, {-0.3, 0.3}};
  std::vector<Mark> footprint_marks;
  double height_m = 1.4;  ///< what hangs higher it passes under
  double track_m = 0.5, wheelbase_m = 0.9;
  double max_speed_mps = 1.6, acceleration_mps2 = 0.6, braking_mps2 = 0.8;
  double stop_mps2 = 1.6;  ///< of a protective stop
  double turn_rate_rad_s = 60 * std::numbers::pi / 180;
  double turn_acceleration_rad_s2 = 180 * std::numbers::pi / 180;
  double max_steering_rad = 75 * std::numbers::pi / 180;
  double steering_rate_rad_s = 60 * std::numbers::pi / 180;
  double lag_s = 0.1;  ///< time constant of its actuators
  OdometrySpec odometry;
  double goal_tolerance_m = 0.05, goal_tolerance_rad = 2 * std::numbers::pi / 180;
  std::vector<ZoneSpec> zones;
};

}  // namespace aisle::sim
