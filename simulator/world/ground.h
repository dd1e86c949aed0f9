#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "simulator/scene/scene.h"
#include "simulator/world/world.h"

namespace aisle::sim {

/// A point of the planned way.
struct WayPoint {
  double distance_m = 0;  ///< from the leg's start
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double heading_rad = 0;      ///< of travel, not of the vehicle, which may drive backwards
  double curvature_per_m = 0;  ///< positive: travel turns left
  double speed_mps = 0;        ///< as cruising speed and corner allow, speeding up left aside
};

/// One stretch of the planned way: a drive, a turn on the spot or a pause.
struct WayLeg {
  enum class Kind { kDrive, kTurn, kPause } kind = Kind::kPause;
  double duration_s = 0;         ///< as planned
  std::vector<WayPoint> points;  ///< of a drive, some centimetres apart
  bool reverse = false;          ///< of a drive: backwards
  double turn_to_rad = 0;        ///< of a turn: the heading at its end, continuous with the start's
};

/// A thing that stands, seen from above: a convex outline, counter-clockwise. One that is not
/// convex is several.
struct GroundThing {
  std::string name, object_class;
  std::vector<Eigen::Vector2d> outline;  ///< metres, world
};

/// What an actor covers of the floor: all within radius_m of a line along its heading. People are
/// discs.
struct GroundActor {
  std::string name, object_class;
  double back_m = 0, front_m = 0;  ///< ends of the line, ahead of its origin
  double radius_m = 0;
  bool yields = false;
  double yields_within_m = 0;
  int goes_with = -1;  ///< index of who pushes or tows it, whose clock it keeps; -1: none
};
struct GroundPose {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double heading_rad = 0;
};

/// The scene as a vehicle meets it: the way it is meant to go, what stands beside it, and who walks
/// there. Pure once built.
class Ground {
 public:
  /// `scene` is one seed's (Seeded); `world` is what was built of it. What stands is what has
  /// triangles between the floor and `drive.height_m`; floors and markings do not count, kerbs do.
  Ground(const Scene& scene, const World& world);

  GroundPose start() const { return start_; }
  const std::vector<WayLeg>& way() const { return way_; }
  const std::vector<GroundThing>& things() const { return things_; }
  /// In the order of the world's movers.
  const std::vector<GroundActor>& actors() const { return actors_; }
  /// Where an actor is at a time of its own.
  GroundPose ActorAt(std::size_t actor, std::int64_t time_ns) const;

 private:
  GroundPose start_;
  std::vector<WayLeg> way_;
  std::vector<GroundThing> things_;
  std::vector<GroundActor> actors_;
  std::vector<Route> routes_;    ///< per actor
  std::vector<double> ahead_m_;  ///< per actor: its origin from its route's, along the heading
  bool frozen_ = false;
};

}  // namespace aisle::sim
