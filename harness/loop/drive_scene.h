#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "harness/contract/sequence.h"
#include "harness/vehicle/driver.h"
#include "harness/vehicle/odometry.h"
#include "harness/vehicle/plant.h"
#include "harness/vehicle/shape.h"

namespace aisle {

/// A thing that stands: a convex outline on the floor.
struct StandingThing {
  std::string name, object_class;
  Polygon outline;
};

/// Somebody who follows a script, which may wait for the vehicle.
struct CourseActor {
  std::string name, object_class;
  bool yields = false;
  double yields_within_m = 0;  ///< from the vehicle's footprint
  int goes_with = -1;          ///< index of the actor whose clock it keeps; -1: its own
};

struct CourseZone {
  std::string name;
  Eigen::Vector2d low = Eigen::Vector2d::Zero(), high = Eigen::Vector2d::Zero();
  double speed_mps = 0;  ///< fastest within; 0: keep out
};

/// What a scene says of a closed drive: the vehicle, its way, and what stands beside it.
struct Course {
  FloorPose start;
  Way way;
  double planned_s = 0;  ///< of the whole way
  Polygon footprint;     ///< in the vehicle's frame
  PlantOptions plant;
  OdometryOptions odometry;
  DriverOptions driver;
  Eigen::Isometry3d T_vehicle_rig = Eigen::Isometry3d::Identity();
  double goal_tolerance_m = 0.05, goal_tolerance_rad = 0.035;
  std::vector<StandingThing> things;
  std::vector<CourseActor> actors;
  std::vector<CourseZone> zones;
};

/// Where an actor is in its script, and how fast it goes through it.
struct ScriptClock {
  std::int64_t time_ns = 0;
  double rate = 1;  ///< 1 as written, 0 stands
};

/// A picture of the course, wherever the vehicle is.
struct Exposure {
  std::int64_t id = 0;
  std::int64_t stamp_ns = 0;  ///< middle of the exposure
  Eigen::Isometry3d T_world_rig = Eigen::Isometry3d::Identity();
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();     ///< of the rig, in its own axes
  Eigen::Vector3d turn_rate_rad_s = Eigen::Vector3d::Zero();  ///< likewise
  std::vector<ScriptClock> clocks = {};                       ///< per actor
  Reckoning wheels = {};                                      ///< of the vehicle's odometer, by now
  /// The same at the frame that the system looked at before this one; none: this is its first.
  std::optional<Reckoning> wheels_before = {};
};

/// The socket for a world in which a vehicle drives by itself. All of it is pure; Take throws
/// std::runtime_error where a picture cannot be had.
class DriveScene {
 public:
  virtual ~DriveScene() = default;
  virtual const Course& course() const = 0;
  virtual StereoCalibration calibration() const = 0;
  virtual double rate_hz() const = 0;
  /// Time of the camera's frame k.
  virtual std::int64_t Stamp(std::int64_t frame) const = 0;
  /// What an actor covers of the floor at a time of its own.
  virtual Capsule ActorAt(std::size_t actor, std::int64_t time_ns) const = 0;
  /// T_world_rig of the vehicle's camera, jolts of that time included.
  virtual Eigen::Isometry3d RigAt(const FloorPose& vehicle, std::int64_t stamp_ns) const = 0;
  virtual SequenceFrame Take(const Exposure& exposure) const = 0;
};

}  // namespace aisle
