#include "simulator/scene/fields.h"

namespace aisle::sim {
namespace {

void DescribeZone(Fields& f, ZoneSpec& zone) {
  zone.mark = f.mark();
  f.Name({"name", "name of the zone in reports", "crossing", true}, &zone.name);
  f.Point({"from", "one corner of the zone", "[2, -1]", true}, &zone.from);
  f.Point({"to", "opposite corner of the zone", "[4, 1]", true}, &zone.to);
  f.Number({"speed_mps", "highest speed within the zone; 0: closed to the vehicle", "0.3"},
           &zone.speed_mps, {0, 20});
}

void DescribeOdometry(Fields& f, OdometrySpec& odometry) {
  f.Number({"radius_error", "relative error of both wheels' radius, rms over seeds", "0.003"},
           &odometry.radius_error, {0, 0.2});
  f.Number(
      {"inequality", "relative difference between the two wheels' radii, rms over seeds", "0.001"},
      &odometry.inequality, {0, 0.2});
  f.Number(
      {"track_error", "relative error of the track width or wheelbase, rms over seeds", "0.005"},
      &odometry.track_error, {0, 0.2});
  f.Degrees(
      {"steering_error_deg", "tricycle: zero error of the steering angle, rms over seeds", "0.2"},
      &odometry.steering_error_rad, {0, 10});
  f.Number({"noise_m", "variance that each metre of way adds, m^2/m", "0.00001"}, &odometry.noise_m,
           {0, 0.01});
  f.Number({"slip_per_mps2", "share of the way that a wheel slips, per m/s^2", "0.004"},
           &odometry.slip_per_mps2, {0, 0.5});
  f.Integer({"counts_per_rev", "counts per turn of the wheel encoders", "4096"},
            &odometry.counts_per_rev, {1, 10000000});
  f.Number({"wheel_radius_m", "radius of the measured wheels", "0.1"}, &odometry.wheel_radius_m,
           {0.01, 2});
}

/// What the vehicle can do.
void DescribeBody(Fields& f, DriveSpec& drive) {
  f.Choice({"kind", "differential: two driven wheels; tricycle: one driven and steered wheel",
            "tricycle"},
           &drive.kind, {"differential", "tricycle"});
  f.Points(
      {"footprint_m", "corners of its outline, x ahead and y left of the middle of the fixed axle",
       "[[-0.3, -0.3], [0.7, -0.3], [0.7, 0.3], [-0.3, 0.3]]"},
      &drive.footprint, &drive.footprint_marks);
  f.Number({"height_m", "height of the vehicle; it passes under what hangs higher", "1.4"},
           &drive.height_m, {0.1, 10});
  f.Number({"track_m", "differential: distance between the wheels", "0.5"}, &drive.track_m,
           {0.05, 5});
  f.Number({"wheelbase_m", "tricycle: distance from the fixed axle to the steered wheel", "0.9"},
           &drive.wheelbase_m, {0.1, 10});
  f.Number({"max_speed_mps", "fastest", "1.6"}, &drive.max_speed_mps, {0.05, 20});
  f.Number({"acceleration_mps2", "acceleration in service", "0.6"}, &drive.acceleration_mps2,
           {0.05, 10});
  f.Number({"braking_mps2", "braking in service", "0.8"}, &drive.braking_mps2, {0.05, 10});
  f.Number({"stop_mps2", "braking in a protective stop", "1.6"}, &drive.stop_mps2, {0.1, 20});
  f.Degrees({"turn_rate_deg_s", "highest turn rate", "60"}, &drive.turn_rate_rad_s, {1, 360});
  f.Degrees({"turn_acceleration_deg_s2", "differential: highest angular acceleration", "180"},
            &drive.turn_acceleration_rad_s2, {1, 3600});
  f.Degrees({"max_steering_deg", "tricycle: largest steering angle to either side", "75"},
            &drive.max_steering_rad, {1, 90});
  f.Degrees({"steering_rate_deg_s", "tricycle: rate of the steering angle", "60"},
            &drive.steering_rate_rad_s, {1, 720});
  f.Number({"lag_s", "time constant of the actuators", "0.1"}, &drive.lag_s, {0, 2});
}

}  // namespace

void DescribeDrive(Fields& f, DriveSpec& drive) {
  drive.mark = f.mark();
  drive.there = true;
  DescribeBody(f, drive);
  f.Choice({"driver", "control law that steers the vehicle", "kanayama"}, &drive.driver,
           {"pure_pursuit", "kanayama"});
  f.Group({"odometry", "errors of the wheel odometry", "{radius_error: 0.003}"},
          [&](Fields& part) { DescribeOdometry(part, drive.odometry); });
  f.Number({"goal_tolerance_m", "largest distance from the goal that counts as reached", "0.05"},
           &drive.goal_tolerance_m, {0.001, 10});
  f.Degrees({"goal_tolerance_deg", "largest heading error that counts as reached", "2"},
            &drive.goal_tolerance_rad, {0.01, 180});
  f.ListOf({"zones", "zones that limit its speed or are closed to it",
            "[{name: crossing, from: [2, -1], to: [4, 1], speed_mps: 0.3}]"},
           &drive.zones, DescribeZone);
}

}  // namespace aisle::sim
