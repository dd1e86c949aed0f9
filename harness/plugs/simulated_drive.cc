#include "harness/plugs/simulated_drive.h"

#include "harness/io/input_error.h"
#include "harness/plugs/ask_simulator.h"
#include "harness/plugs/bag_poses.h"
#include "harness/plugs/open_simulator.h"
#include "harness/plugs/simulated_frame.h"
#include "simulator/scene_file.h"
#include "simulator/site.h"

namespace aisle {
namespace {

PlantOptions PlantOf(const sim::DriveSpec& drive) {
  return {.kind = drive.kind == sim::DriveKind::kTricycle ? VehicleKind::kTricycle
                                                          : VehicleKind::kDifferential,
          .track_m = drive.track_m,
          .wheelbase_m = drive.wheelbase_m,
          .max_speed_mps = drive.max_speed_mps,
          .acceleration_mps2 = drive.acceleration_mps2,
          .braking_mps2 = drive.braking_mps2,
          .stop_mps2 = drive.stop_mps2,
          .max_turn_rate_rad_s = drive.turn_rate_rad_s,
          .turn_acceleration_rad_s2 = drive.turn_acceleration_rad_s2,
          .max_steering_rad = drive.max_steering_rad,
          .steering_rate_rad_s = drive.steering_rate_rad_s,
          .lag_s = drive.lag_s};
}

OdometryOptions OdometryOf(const sim::OdometrySpec& odometry) {
  return {.radius_error = odometry.radius_error,
          .inequality = odometry.inequality,
          .track_error = odometry.track_error,
          .steering_error_rad = odometry.steering_error_rad,
          .noise_m = odometry.noise_m,
          .slip_per_mps2 = odometry.slip_per_mps2,
          .counts_per_rev = odometry.counts_per_rev,
          .wheel_radius_m = odometry.wheel_radius_m};
}

DriverOptions DriverOf(const sim::DriveSpec& drive, const sim::RouteLimits& limits) {
  DriverOptions driver;
  if (drive.driver == sim::DriverLaw::kKanayama) driver.law = SteeringLaw::kKanayama;
  // What the plan asks for in bends and before ends, the vehicle must be able to do.
  driver.braking_mps2 = std::min(limits.acceleration_mps2, 0.8 * drive.braking_mps2);
  driver.docking_mps2 = std::min(driver.docking_mps2, driver.braking_mps2);
  driver.turn_rate_rad_s = std::min(limits.turn_rate_rad_s, drive.turn_rate_rad_s);
  driver.turn_braking_rad_s2 =
      std::min(limits.turn_acceleration_rad_s2, drive.turn_acceleration_rad_s2) / 2;
  driver.reach_m = ReachOf(drive.footprint);
  driver.lag_s = drive.lag_s;
  return driver;
}

WayLeg::Kind KindOf(sim::WayLeg::Kind kind) {
  switch (kind) {
    case sim::WayLeg::Kind::kDrive:
      return WayLeg::Kind::kDrive;
    case sim::WayLeg::Kind::kTurn:
      return WayLeg::Kind::kTurn;
    case sim::WayLeg::Kind::kPause:
      return WayLeg::Kind::kPause;
  }
  return WayLeg::Kind::kPause;
}

Way WayOf(const std::vector<sim::WayLeg>& planned) {
  Way way;
  for (const sim::WayLeg& leg : planned) {
    WayLeg next{.kind = KindOf(leg.kind),
                .duration_s = leg.duration_s,
                .points = {},
                .reverse = leg.reverse,
                .turn_to_rad = leg.turn_to_rad};
    for (const sim::WayPoint& point : leg.points) {
      next.points.push_back({point.distance_m, point.position, point.heading_rad,
                             point.curvature_per_m, point.speed_mps});
    }
    way.push_back(std::move(next));
  }
  return way;
}

Course CourseOf(const sim::Site& site) {
  const sim::DriveSpec& drive = site.drive();
  const sim::Ground& ground = site.ground();
  Course course;
  course.start = {ground.start().position, ground.start().heading_rad};
  course.way = WayOf(ground.way());
  for (const WayLeg& leg : course.way) course.planned_s += leg.duration_s;
  course.footprint = drive.footprint;
  course.plant = PlantOf(drive);
  course.odometry = OdometryOf(drive.odometry);
  course.driver = DriverOf(drive, site.limits());
  course.T_vehicle_rig = site.Mount();
  course.goal_tolerance_m = drive.goal_tolerance_m;
  course.goal_tolerance_rad = drive.goal_tolerance_rad;
  for (const sim::GroundThing& thing : ground.things()) {
    course.things.push_back({thing.name, thing.object_class, thing.outline});
  }
  for (const sim::GroundActor& actor : ground.actors()) {
    course.actors.push_back(
        {actor.name, actor.object_class, actor.yields, actor.yields_within_m, actor.goes_with});
  }
  for (const sim::ZoneSpec& zone : drive.zones) {
    course.zones.push_back(
        {zone.name, zone.from.cwiseMin(zone.to), zone.from.cwiseMax(zone.to), zone.speed_mps});
  }
  return course;
}

class SimulatedDrive : public DriveScene {
 public:
  explicit SimulatedDrive(sim::Simulator simulator)
      : simulator_(std::move(simulator)), course_(CourseOf(simulator_.site())) {}

  const Course& course() const override { return course_; }
  StereoCalibration calibration() const override { return CalibrationOf(simulator_.rig()); }
  double rate_hz() const override { return simulator_.rate_hz(); }
  std::int64_t Stamp(std::int64_t frame) const override {
    return simulator_.Stamp(static_cast<int>(frame));
  }

  Capsule ActorAt(std::size_t index, std::int64_t time_ns) const override {
    const sim::GroundActor& actor = simulator_.site().ground().actors()[index];
    const sim::GroundPose at = simulator_.site().ground().ActorAt(index, time_ns);
    const Eigen::Vector2d ahead = FloorPose{at.position, at.heading_rad}.ahead();
    return {at.position + actor.back_m * ahead, at.position + actor.front_m * ahead,
            actor.radius_m};
  }

  Eigen::Isometry3d RigAt(const FloorPose& vehicle, std::int64_t stamp_ns) const override {
    return simulator_.site().RigPoseAt({vehicle.position, vehicle.heading_rad}, stamp_ns);
  }

  SequenceFrame Take(const Exposure& exposure) const override {
    sim::Shot shot{.T_world_rig = exposure.T_world_rig,
                   .velocity_mps = exposure.velocity_mps,
                   .turn_rate_rad_s = exposure.turn_rate_rad_s};
    for (const ScriptClock& clock : exposure.clocks) {
      shot.clocks.push_back({clock.time_ns, clock.rate});
    }
    const int id = static_cast<int>(exposure.id);
    return FrameOf(exposure.id, simulator_.Render(id, exposure.stamp_ns, shot),
                   simulator_.instances());
  }

 private:
  sim::Simulator simulator_;
  Course course_;
};

sim::DriveSpec DriveOfScene(const std::string& scene_file) {
  return AskSimulator([&] { return sim::ReadSceneInfo(scene_file, 1, ReadPosesOfBag).drive; });
}

}  // namespace

bool IsDriveScene(const std::string& scene_file) { return DriveOfScene(scene_file).there; }

Wheels WheelsOfScene(const std::string& scene_file) {
  const sim::DriveSpec drive = DriveOfScene(scene_file);
  return drive.there ? Wheels{OdometryOf(drive.odometry), PlantOf(drive)} : Wheels{};
}

std::unique_ptr<DriveScene> OpenSimulatedDrive(const SimulatedSequenceOptions& options,
                                               std::uint64_t* content_hash) {
  sim::Simulator simulator = OpenSimulator(options);
  RefuseLens(simulator, options);
  if (!simulator.site().drive().there) {
    throw InputError(options.scene_file, 0,
                     "has no `drive` to say which vehicle is steered; example: drive: {}");
  }
  if (content_hash != nullptr) *content_hash = simulator.content_hash();
  return std::make_unique<SimulatedDrive>(std::move(simulator));
}

}  // namespace aisle
