#include "harness/vehicle/shape.h"

#include <algorithm>

namespace aisle {
namespace {

double Turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

double DistanceToLine(const Eigen::Vector2d& point, const Eigen::Vector2d& from,
                      const Eigen::Vector2d& to) {
  const Eigen::Vector2d along = to - from;
  const double squared = along.squaredNorm();
  const double share = squared > 0 ? std::clamp((point - from).dot(along) / squared, 0.0, 1.0) : 0;
  return (point - from - share * along).norm();
}

template <class EachSide>
void ForSides(const Polygon& polygon, const EachSide& side) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    side(polygon[i], polygon[(i + 1) % polygon.size()]);
  }
}

}  // namespace

Polygon At(const FloorPose& pose, const Polygon& polygon) {
  Polygon placed;
  placed.reserve(polygon.size());
  for (const Eigen::Vector2d& corner : polygon) placed.push_back(pose * corner);
  return placed;
}

bool Contains(const Polygon& polygon, const Eigen::Vector2d& point) {
  bool inside = false;  // crossings of a ray to the right
  ForSides(polygon, [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    if ((a.y() > point.y()) == (b.y() > point.y())) return;
    const double x = a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    if (point.x() < x) inside = !inside;
  });
  return inside;
}

double Distance(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                const Eigen::Vector2d& d) {
  if (Turn(a, b, c) * Turn(a, b, d) < 0 && Turn(c, d, a) * Turn(c, d, b) < 0) return 0;
  return std::min({DistanceToLine(a, c, d), DistanceToLine(b, c, d), DistanceToLine(c, a, b),
                   DistanceToLine(d, a, b)});
}

double Distance(const Polygon& a, const Polygon& b) {
  if (Contains(a, b.front()) || Contains(b, a.front())) return 0;
  double least = std::numeric_limits<double>::infinity();
  ForSides(a, [&](const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
    ForSides(b, [&](const Eigen::Vector2d& r, const Eigen::Vector2d& s) {
      least = std::min(least, Distance(p, q, r, s));
    });
  });
  return least;
}

double Distance(const Polygon& polygon, const Capsule& capsule) {
  if (Contains(polygon, capsule.from)) return 0;
  double least = std::numeric_limits<double>::infinity();
  ForSides(polygon, [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    least = std::min(least, Distance(a, b, capsule.from, capsule.to));
  });
  return std::max(0.0, least - capsule.radius_m);
}

double ReachOf(const Polygon& polygon) {
  double reach = 0;
  for (const Eigen::Vector2d& corner : polygon) reach = std::max(reach, corner.norm());
  return reach;
}

double FastestCorner(const Polygon& polygon, double speed_mps, double turn_rate_rad_s) {
  double fastest = 0;
  for (const Eigen::Vector2d& corner : polygon) {
    fastest = std::max(fastest, std::hypot(speed_mps - turn_rate_rad_s * corner.y(),
                                           turn_rate_rad_s * corner.x()));
  }
  return fastest;
}

Box BoxOf(const Polygon& polygon) {
  Box box{polygon.front(), polygon.front()};
  for (const Eigen::Vector2d& corner : polygon) {
    box.low = box.low.cwiseMin(corner);
    box.high = box.high.cwiseMax(corner);
  }
  return box;
}

}  // namespace aisle
