#include "harness/vehicle/taught_way.h"

#include <algorithm>
#include <limits>

namespace aisle {
namespace {

/// Looks through the poses in the order in which they were taught.
class Teaching {
 public:
  explicit Teaching(const std::vector<TaughtPose>& poses) : poses_(poses) {}

  /// A pose of the site as the map has it, by what the map was off where the vehicle came nearest,
  /// from where it was last asked about.
  FloorPose Said(const FloorPose& site) {
    const auto away_m = [&](std::size_t i) {
      return (poses_[i].led.position - site.position).norm();
    };
    GoTo(away_m);
    // Between two frames the one's error passes into the other's.
    const std::size_t from = at_, to = NeighbourToward(site.position);
    const double before_m = away_m(from), after_m = away_m(to);
    const double share = before_m + after_m > 0 ? before_m / (before_m + after_m) : 0;
    const FloorPose by_one = Moved(from, site), by_other = Moved(to, site);
    return {by_one.position + share * (by_other.position - by_one.position),
            by_one.heading_rad + share * WrapAngle(by_other.heading_rad - by_one.heading_rad)};
  }

  /// A heading that was turned to on the spot.
  double SaidAfterTurn(double heading_rad) {
    GoTo([&](std::size_t i) {
      const double turned_m = (poses_[i].led.position - poses_[at_].led.position).norm();
      return turned_m + std::abs(WrapAngle(poses_[i].led.heading_rad - heading_rad));
    });
    return Moved(at_, {poses_[at_].led.position, heading_rad}).heading_rad;
  }

 private:
  /// On to where a cost is least within the next stretch of the drive.
  template <typename Cost>
  void GoTo(const Cost& cost) {
    constexpr double kStretch_m = 0.3;
    double least = std::numeric_limits<double>::infinity(), driven_m = 0;
    std::size_t best = at_;
    // The next frame too, however far: while the SLAM was lost none was taught.
    for (std::size_t i = at_; i < poses_.size() && (driven_m <= kStretch_m || i <= at_ + 1); ++i) {
      const double now = cost(i);
      if (now < least) {
        least = now;
        best = i;
      }
      if (i + 1 < poses_.size()) {
        driven_m += (poses_[i + 1].led.position - poses_[i].led.position).norm();
      }
    }
    at_ = best;
  }

  /// The frame before or after the nearest, on whose side the place is; beyond the ends itself.
  std::size_t NeighbourToward(const Eigen::Vector2d& place) const {
    const FloorPose& led = poses_[at_].led;
    const auto is_on_side_of = [&](std::size_t other) {
      return (place - led.position).dot(poses_[other].led.position - led.position) > 0;
    };
    if (at_ + 1 < poses_.size() && is_on_side_of(at_ + 1)) return at_ + 1;
    if (at_ > 0 && is_on_side_of(at_ - 1)) return at_ - 1;
    return at_;
  }

  FloorPose Moved(std::size_t by, const FloorPose& site) const {
    const TaughtPose& pose = poses_[by];
    FloorPose moved = pose.said * (pose.led.inverse() * site);
    moved.heading_rad = site.heading_rad + WrapAngle(moved.heading_rad - site.heading_rad);
    return moved;
  }

  const std::vector<TaughtPose>& poses_;
  std::size_t at_ = 0;
};

}  // namespace

Way TaughtWay(const Way& planned, const std::vector<TaughtPose>& poses) {
  if (poses.empty()) return planned;
  Way taught = planned;
  Teaching teaching(poses);
  for (WayLeg& leg : taught) {
    if (leg.kind == WayLeg::Kind::kTurn) leg.turn_to_rad = teaching.SaidAfterTurn(leg.turn_to_rad);
    for (std::size_t i = 0; i < leg.points.size(); ++i) {
      WayPoint& point = leg.points[i];
      const FloorPose said = teaching.Said({point.position, point.heading_rad});
      point.position = said.position;
      point.heading_rad = said.heading_rad;
      if (i == 0) continue;
      const WayPoint& before = leg.points[i - 1];
      point.distance_m = before.distance_m + (point.position - before.position).norm();
    }
  }
  return taught;
}

}  // namespace aisle
