#include "harness/vehicle/way.h"

#include <algorithm>

namespace aisle {

WayPoint PointAt(const WayLeg& leg, double distance_m) {
  const std::vector<WayPoint>& points = leg.points;
  const auto straight = [&](const WayPoint& from, double on_m) {
    WayPoint point = from;
    point.position +=
        on_m * Eigen::Vector2d(std::cos(from.heading_rad), std::sin(from.heading_rad));
    point.distance_m += on_m;
    point.curvature_per_m = 0;
    return point;
  };
  if (distance_m <= 0) return straight(points.front(), distance_m);
  if (distance_m >= points.back().distance_m) {
    return straight(points.back(), distance_m - points.back().distance_m);
  }
  const auto next =
      std::upper_bound(points.begin(), points.end(), distance_m,
                       [](double at, const WayPoint& point) { return at < point.distance_m; });
  const WayPoint &a = *std::prev(next), &b = *next;
  const double share = (distance_m - a.distance_m) / (b.distance_m - a.distance_m);
  const auto mix = [&](double from, double to) { return from + share * (to - from); };
  return {.distance_m = distance_m,
          .position = a.position + share * (b.position - a.position),
          .heading_rad = mix(a.heading_rad, b.heading_rad),
          .curvature_per_m = mix(a.curvature_per_m, b.curvature_per_m),
          .speed_mps = mix(a.speed_mps, b.speed_mps)};
}

OnWay Nearest(const WayLeg& leg, const Eigen::Vector2d& point, double around_m, double back_m,
              double ahead_m) {
  const std::vector<WayPoint>& points = leg.points;
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool near =
        points[i].distance_m >= around_m - back_m && points[i].distance_m <= around_m + ahead_m;
    const double squared = (points[i].position - point).squaredNorm();
    if (near && squared < least) {
      least = squared;
      best = i;
    }
  }
  // From the nearest sample on along its tangent: exact beyond the ends and to a fraction of the
  // samples' distance, squared, between them.
  const WayPoint& at = points[best];
  const Eigen::Vector2d along(std::cos(at.heading_rad), std::sin(at.heading_rad));
  const double on_m = along.dot(point - at.position);
  const WayPoint foot = PointAt(leg, at.distance_m + on_m);
  const Eigen::Vector2d left(-std::sin(foot.heading_rad), std::cos(foot.heading_rad));
  return {foot.distance_m, left.dot(point - foot.position), foot.heading_rad};
}

WayLeg WithBraking(WayLeg leg, double braking_mps2) {
  for (std::size_t i = leg.points.size(); i-- > 1;) {
    const WayPoint& next = leg.points[i];
    WayPoint& here = leg.points[i - 1];
    const double way = next.distance_m - here.distance_m;
    here.speed_mps = std::min(here.speed_mps,
                              std::sqrt(next.speed_mps * next.speed_mps + 2 * braking_mps2 * way));
  }
  return leg;
}

}  // namespace aisle
