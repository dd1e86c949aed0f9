#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "harness/contract/drive_log.h"
#include "harness/loop/drive_scene.h"

namespace aisle {

/// The vehicle and everybody around it, at one instant.
struct Encounter {
  std::int64_t stamp_ns = 0;
  FloorPose vehicle;
  double speed_mps = 0;
  std::vector<Capsule> actors;
  double turn_rate_rad_s = 0;
};

/// Looks out for what the vehicle touches, from instant to instant and swept between them, and for
/// how near it comes. Truth's business: nothing of it reaches the driver.
class ContactWatch {
 public:
  ContactWatch(const Course& course, DriveTrack* track);

  /// The next instant; the vehicle came by the arc of that way and turn.
  void See(const Encounter& now, double way_m, double turn_rad);

  double clearance_static_m() const { return static_m_; }
  double clearance_actor_m() const { return actor_m_; }
  bool hit_static() const { return hit_static_; }

 private:
  void SeeThings(const Encounter& now, const Polygon& footprint, double moved_m);
  void SeeActors(const Encounter& now, const Polygon& footprint, double moved_m);
  void SeeZones(const Encounter& now, const Polygon& footprint);
  void Touch(bool touches, const std::string& key, const Contact& contact);
  template <class DistanceAt>
  bool TouchesBetween(const DistanceAt& distance, double from, double to, double at_from,
                      double at_to, double moved_m) const;
  FloorPose VehicleAt(double share) const;
  double TouchSpeed(const Encounter& now) const;
  bool DrivesInto(const Encounter& now, const Polygon& footprint, const Capsule& there) const;

  const Course& course_;
  DriveTrack* track_;
  const double reach_m_;
  std::vector<Box> boxes_;  ///< per thing
  std::optional<Encounter> before_;
  double way_m_ = 0, turn_rad_ = 0;      ///< since before_
  std::vector<double> distances_;        ///< per actor, before
  std::vector<double> thing_distances_;  ///< per thing, before; infinite: far
  double static_m_ = std::numeric_limits<double>::infinity();
  double actor_m_ = std::numeric_limits<double>::infinity();
  std::set<std::string> touching_;
  bool hit_static_ = false;
};

}  // namespace aisle
