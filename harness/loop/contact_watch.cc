#include "harness/loop/contact_watch.h"

#include <algorithm>

#include "harness/common/seconds.h"

namespace aisle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFinest_m = 1e-3;     // swept motion is looked at in steps of this at the coarsest
constexpr double kLetGo_m = 0.02;      // a contact is over when they are this far apart again
constexpr double kFar_m = 3;           // of no interest
constexpr double kClosing_mps = 0.05;  // slower is no approach

}  // namespace

ContactWatch::ContactWatch(const Course& course, DriveTrack* track)
    : course_(course),
      track_(track),
      reach_m_(ReachOf(course.footprint)),
      distances_(course.actors.size(), kInfinity),
      thing_distances_(course.things.size(), kInfinity) {
  for (const StandingThing& thing : course.things) boxes_.push_back(BoxOf(thing.outline));
}

FloorPose ContactWatch::VehicleAt(double share) const {
  return AlongArc(before_->vehicle, share * way_m_, share * turn_rad_);
}

/// Of the vehicle's fastest corner.
double ContactWatch::TouchSpeed(const Encounter& now) const {
  return FastestCorner(course_.footprint, now.speed_mps, now.turn_rate_rad_s);
}

/// Whether the vehicle's own motion closes the gap to where somebody is now. Held against the
/// middle of him, as who leans on the vehicle has no gap to it; within it every motion is into him.
bool ContactWatch::DrivesInto(const Encounter& now, const Polygon& footprint,
                              const Capsule& there) const {
  const Capsule middle{there.from, there.to, 0};
  const double gap = Distance(footprint, middle);
  if (!before_ || gap <= 0) return true;
  const double closed = Distance(At(before_->vehicle, course_.footprint), middle) - gap;
  return closed > kUnderWay_mps * 1e-9 * static_cast<double>(now.stamp_ns - before_->stamp_ns);
}

/// Whether a distance that changes by at most `moved_m` over the whole step reaches 0 between two
/// shares of it: halves the step until the motion is a millimetre.
template <class DistanceAt>
bool ContactWatch::TouchesBetween(const DistanceAt& distance, double from, double to,
                                  double at_from, double at_to, double moved_m) const {
  if (at_from <= 0 || at_to <= 0) return true;
  const double moved = moved_m * (to - from);
  if (at_from + at_to > moved || moved < kFinest_m) return false;
  const double middle = (from + to) / 2, at_middle = distance(middle);
  return TouchesBetween(distance, from, middle, at_from, at_middle, moved_m) ||
         TouchesBetween(distance, middle, to, at_middle, at_to, moved_m);
}

void ContactWatch::Touch(bool touches, const std::string& key, const Contact& contact) {
  if (!touches || !touching_.insert(key).second) return;
  track_->contacts.push_back(contact);
  hit_static_ = hit_static_ || !contact.is_actor;
}

void ContactWatch::SeeThings(const Encounter& now, const Polygon& footprint, double moved_m) {
  static_m_ = kInfinity;
  const double reach = reach_m_ + kFar_m;
  for (std::size_t i = 0; i < course_.things.size(); ++i) {
    const StandingThing& thing = course_.things[i];
    const Eigen::Vector2d& at = now.vehicle.position;
    const Eigen::Vector2d off =
        (boxes_[i].low - at).cwiseMax(at - boxes_[i].high).cwiseMax(Eigen::Vector2d::Zero());
    const double far = off.norm() - reach_m_;
    if (off.norm() > reach || (far > static_m_ && far > 2 * moved_m)) {
      thing_distances_[i] = kInfinity;
      continue;
    }
    const double distance = Distance(footprint, thing.outline);
    const auto between = [&](double share) {
      return Distance(At(VehicleAt(share), course_.footprint), thing.outline);
    };
    const bool touches = before_
                             ? TouchesBetween(between, 0, 1, thing_distances_[i], distance, moved_m)
                             : distance <= 0;
    static_m_ = std::min(static_m_, touches ? 0 : distance);
    const std::string key = fmt::format("thing {}", i);
    Touch(touches, key,
          {now.stamp_ns, thing.name, thing.object_class, TouchSpeed(now), now.vehicle, false});
    if (distance > kLetGo_m) touching_.erase(key);
    thing_distances_[i] = distance;
  }
  track_->min_clearance_static_m = std::min(track_->min_clearance_static_m, static_m_);
}

void ContactWatch::SeeActors(const Encounter& now, const Polygon& footprint, double moved_m) {
  actor_m_ = kInfinity;
  const bool under_way = TouchSpeed(now) > kUnderWay_mps;
  for (std::size_t i = 0; i < now.actors.size(); ++i) {
    const CourseActor& actor = course_.actors[i];
    const Capsule& there = now.actors[i];
    const double distance = Distance(footprint, there);
    const auto between = [&](double share) {
      const Capsule& from = before_->actors[i];
      const Capsule placed{from.from + share * (there.from - from.from),
                           from.to + share * (there.to - from.to), there.radius_m};
      return Distance(At(VehicleAt(share), course_.footprint), placed);
    };
    double moved = moved_m;
    if (before_) {
      moved += std::max((there.from - before_->actors[i].from).norm(),
                        (there.to - before_->actors[i].to).norm());
    }
    const bool touches =
        before_ ? TouchesBetween(between, 0, 1, distances_[i], distance, moved) : distance <= 0;
    const double gap = touches ? 0 : distance;
    actor_m_ = std::min(actor_m_, gap);
    // Somebody who touches the vehicle that stands, and is then driven into, is touched twice.
    const std::string key = fmt::format("actor {}", i), driven_into = key + " under way";
    const bool drives_into =
        under_way && (!touching_.contains(key) || DrivesInto(now, footprint, there));
    Touch(touches, drives_into ? driven_into : key,
          {now.stamp_ns, actor.name, actor.object_class, TouchSpeed(now), now.vehicle, true});
    if (touches) touching_.insert(key);
    if (distance > kLetGo_m) touching_.erase(key), touching_.erase(driven_into);
    if (under_way && before_) {
      double& least = actor.object_class == "person" ? track_->min_clearance_person_m
                                                     : track_->min_clearance_vehicle_m;
      least = std::min(least, gap);
      const double over_s = ToSeconds(now.stamp_ns - before_->stamp_ns);
      const double closing = over_s > 0 ? (distances_[i] - distance) / over_s : 0;
      if (closing > kClosing_mps) {
        track_->min_time_to_collision_s =
            std::min(track_->min_time_to_collision_s, distance / closing);
      }
      if (touches && drives_into) track_->min_time_to_collision_s = 0;
    }
    distances_[i] = distance;
  }
}

void ContactWatch::SeeZones(const Encounter& now, const Polygon& footprint) {
  constexpr double kTooFast_mps = 0.02;  // over the zone's speed
  for (std::size_t i = 0; i < course_.zones.size(); ++i) {
    const CourseZone& zone = course_.zones[i];
    const Polygon area = {
        zone.low, {zone.high.x(), zone.low.y()}, zone.high, {zone.low.x(), zone.high.y()}};
    const std::string key = fmt::format("zone {}", i);  // names may be given twice
    const bool within = Distance(footprint, area) <= 0;
    const bool breaks =
        within && (zone.speed_mps == 0 || std::abs(now.speed_mps) > zone.speed_mps + kTooFast_mps);
    if (breaks && touching_.insert(key).second) {
      track_->violations.push_back({now.stamp_ns, zone.name, now.speed_mps});
    }
    if (!within) touching_.erase(key);
  }
}

void ContactWatch::See(const Encounter& now, double way_m, double turn_rad) {
  way_m_ = way_m;
  turn_rad_ = turn_rad;
  const double moved_m = std::abs(way_m) + std::abs(turn_rad) * reach_m_;
  const Polygon footprint = At(now.vehicle, course_.footprint);
  SeeThings(now, footprint, moved_m);
  SeeActors(now, footprint, moved_m);
  SeeZones(now, footprint);
  before_ = now;
}

}  // namespace aisle
