#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "harness/contract/floor.h"

namespace aisle {

/// A vehicle whose fastest corner is no faster stands: what touches it then is not its doing. Who
/// watches for contacts splits "touched" from "driven into" by it, and the score leaves out the
/// former by the same bound.
inline constexpr double kUnderWay_mps = 0.02;
/// Who is as near to the end of a leg has driven all of it: the last centimetres are the docking's
/// matter.
inline constexpr double kLegEnd_m = 0.05;

/// What a vehicle under way is doing.
enum class DriveMode {
  kDriving,
  kWaiting,   ///< as its route says, or for the first pose
  kDegraded,  ///< creeps by its wheels alone: the system is late or lost
  kStopped,   ///< protective stop: the system has been lost for too long
  kScanner,   ///< the safety scanner holds it
  kArrived,   ///< it believes that it stands at its goal
};

/// A vehicle at one instant of its drive.
struct DriveSample {
  std::int64_t stamp_ns = 0;
  FloorPose truth;               ///< of the vehicle: the middle of its fixed axle
  FloorPose belief;              ///< where it takes itself to be
  double speed_mps = 0;          ///< true, backwards negative
  double yaw_rate_rad_s = 0;     ///< true
  double cross_track_m = 0;      ///< of the true vehicle from the planned route, left positive
  double heading_error_rad = 0;  ///< of the true vehicle from the route's heading
  double route_m = 0;            ///< how far along the route it truly is
  double estimate_age_s = 0;     ///< of the pose that it steers by
  double clearance_static_m = std::numeric_limits<double>::infinity();
  double clearance_actor_m = std::numeric_limits<double>::infinity();
  DriveMode mode = DriveMode::kWaiting;
  bool operator==(const DriveSample&) const = default;
};

/// The footprint began to touch something.
struct Contact {
  std::int64_t stamp_ns = 0;
  std::string with;          ///< its name in the scene
  std::string object_class;  ///< "rack", "person", …
  double speed_mps = 0;      ///< of the vehicle's fastest corner, 0 or more
  FloorPose vehicle;
  bool is_actor = false;
  bool operator==(const Contact&) const = default;
};

/// The vehicle went where it must not, or too fast.
struct ZoneViolation {
  std::int64_t stamp_ns = 0;
  std::string zone;
  double speed_mps = 0;
  bool operator==(const ZoneViolation&) const = default;
};

/// A thing that stands, seen from above.
struct FloorThing {
  std::string name, object_class;
  std::vector<Eigen::Vector2d> outline;  ///< convex, metres, world
};

/// Where somebody was at each sample of a drive: all within a radius of a line.
struct ActorTrack {
  std::string name, object_class;
  double radius_m = 0;
  std::vector<Eigen::Vector2d> from = {}, to = {};  ///< ends of the line; people's coincide
  bool operator==(const ActorTrack&) const = default;
};

enum class DriveEnd {
  kArrived,     ///< it believes that it stands at its goal
  kContact,     ///< it ran into something that stands
  kNoProgress,  ///< it stood for too long
  kTimeout,     ///< it took several times as long as planned
  kFailed,      ///< the system crashed, hung or spoke nonsense
};

/// One drive in closed loop.
struct DriveTrack {
  std::vector<DriveSample> samples;  ///< by time
  std::vector<ActorTrack> actors;    ///< as many places each as there are samples
  std::vector<Contact> contacts;
  std::vector<ZoneViolation> violations;
  DriveEnd end = DriveEnd::kTimeout;
  double time_s = 0;  ///< until it ended
  double min_clearance_static_m = std::numeric_limits<double>::infinity();
  double min_clearance_person_m = std::numeric_limits<double>::infinity();
  double min_clearance_vehicle_m = std::numeric_limits<double>::infinity();
  /// Least gap over closing speed to a person or vehicle; infinite where none came nearer.
  double min_time_to_collision_s = std::numeric_limits<double>::infinity();
  int stops = 0;  ///< protective ones
  int scanner_stops = 0;
  double stopped_s = 0;                  ///< held by either
  double lost_s = 0;                     ///< without a pose it could steer by: degraded or stopped
  int frames_due = 0, frames_shown = 0;  ///< of the camera; to the system
  bool operator==(const DriveTrack&) const = default;
};

/// All that a closed drive left behind beside its poses.
struct DriveLog {
  std::vector<FloorPose> route;  ///< as planned, some centimetres apart
  double route_m = 0;            ///< its length
  double planned_s = 0;
  FloorPose goal;
  double goal_tolerance_m = 0, goal_tolerance_rad = 0;
  std::vector<Eigen::Vector2d> footprint;  ///< in the vehicle's frame
  std::vector<FloorThing> things;          ///< that stand near the route
  double latency_ms = 0;
  std::string steered_by;  ///< "estimate" or "truth"
  bool taught = false;     ///< by a taught way; beliefs are places of the map of that teaching
  DriveTrack track;
  /// The same vehicle at the same latency, told its true pose: what of the error is the driver's.
  DriveTrack truth_steered;
  double loop_ms = 0;  ///< wall time of everything but rendering and the system, a frame; no score
};

}  // namespace aisle
