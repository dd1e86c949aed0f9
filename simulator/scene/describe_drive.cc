#include "simulator/scene/fields.h"

namespace aisle::sim {
namespace {

void DescribeZone(Fields& f, ZoneSpec& zone) {
  zone.mark = f.mark();
  f.Name({"name", "ends up in reports", "crossing", true}, &zone.name);
  f.Point({"from", "corner", "[2, -1]", true}, &zone.from);
  f.Point({"to", "opposite corner", "[4, 1]", true}, &zone.to);
  f.Number({"speed_mps", "fastest within; 0: the vehicle keeps out", "0.3"}, &zone.speed_mps,
           {0, 20});
}

void DescribeOdometry(Fields& f, OdometrySpec& odometry) {
  f.Number({"radius_error", "share by which both wheels' radius is off, rms over seeds", "0.003"},
           &odometry.radius_error, {0, 0.2});
  f.Number({"inequality", "share by which one wheel's radius differs from the other's", "0.001"},
           &odometry.inequality, {0, 0.2});
  f.Number({"track_error", "share by which track width or wheelbase is off", "0.005"},
           &odometry.track_error, {0, 0.2});
  f.Degrees({"steering_error_deg", "of a tricycle: by which the steering's zero is off", "0.2"},
            &odometry.steering_error_rad, {0, 10});
  f.Number({"noise_m", "variance that a metre of way adds to it, m^2/m", "0.00001"},
           &odometry.noise_m, {0, 0.01});
  f.Number({"slip_per_mps2", "share of the way by which a wheel slips, per m/s^2", "0.004"},
           &odometry.slip_per_mps2, {0, 0.5});
  f.Integer({"counts_per_rev", "of the wheel encoders", "4096"}, &odometry.counts_per_rev,
            {1, 10000000});
  f.Number({"wheel_radius_m", "of the measured wheels", "0.1"}, &odometry.wheel_radius_m,
           {0.01, 2});
}

/// What the vehicle can do.
void DescribeBody(Fields& f, DriveSpec& drive) {
  f.Choice({"kind", "two driven wheels, or one that is driven and steered", "tricycle"},
           &drive.kind, {"differential", "tricycle"});
  f.Points({"footprint_m", "its corners, x ahead and y left of the middle of the fixed axle",
            "[[-0.3, -0.3], [0.7, -0.3], [0.7, 0.3], [-0.3, 0.3]]"},
           &drive.footprint, &drive.footprint_marks);
  f.Number({"height_m", "what hangs higher it passes under", "1.4"}, &drive.height_m, {0.1, 10});
  f.Number({"track_m", "of a differential drive: from wheel to wheel", "0.5"}, &drive.track_m,
           {0.05, 5});
  f.Number({"wheelbase_m", "of a tricycle: from the fixed axle to the steered wheel", "0.9"},
           &drive.wheelbase_m, {0.1, 10});
  f.Number({"max_speed_mps", "fastest", "1.6"}, &drive.max_speed_mps, {0.05, 20});
  f.Number({"acceleration_mps2", "speeding up", "0.6"}, &drive.acceleration_mps2, {0.05, 10});
  f.Number({"braking_mps2", "slowing down in service", "0.8"}, &drive.braking_mps2, {0.05, 10});
  f.Number({"stop_mps2", "slowing down in a protective stop", "1.6"}, &drive.stop_mps2, {0.1, 20});
  f.Degrees({"turn_rate_deg_s", "fastest turning", "60"}, &drive.turn_rate_rad_s, {1, 360});
  f.Degrees({"turn_acceleration_deg_s2", "of a differential drive", "180"},
            &drive.turn_acceleration_rad_s2, {1, 3600});
  f.Degrees({"max_steering_deg", "of a tricycle: to either side", "75"}, &drive.max_steering_rad,
            {1, 90});
  f.Degrees({"steering_rate_deg_s", "of a tricycle: how fast it steers", "60"},
            &drive.steering_rate_rad_s, {1, 720});
  f.Number({"lag_s", "time constant of its actuators", "0.1"}, &drive.lag_s, {0, 2});
}

}  // namespace

void DescribeDrive(Fields& f, DriveSpec& drive) {
  drive.mark = f.mark();
  drive.there = true;
  DescribeBody(f, drive);
  f.Choice({"driver", "the law it steers by", "kanayama"}, &drive.driver,
           {"pure_pursuit", "kanayama"});
  f.Group({"odometry", "how the wheels' own measurement errs", "{radius_error: 0.003}"},
          [&](Fields& part) { DescribeOdometry(part, drive.odometry); });
  f.Number({"goal_tolerance_m", "the goal is reached within this distance", "0.05"},
           &drive.goal_tolerance_m, {0.001, 10});
  f.Degrees({"goal_tolerance_deg", "and this turn", "2"}, &drive.goal_tolerance_rad, {0.01, 180});
  f.ListOf({"zones", "where it must go slowly, or not at all",
            "[{name: crossing, from: [2, -1], to: [4, 1], speed_mps: 0.3}]"},
           &drive.zones, DescribeZone);
}

}  // namespace aisle::sim
