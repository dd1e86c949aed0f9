#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace aisle::sim {

/// A point of a path on the floor plane.
struct PathPoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< metres, world x and y
  double heading_rad = 0;      ///< direction of travel, counter-clockwise from world x
  double curvature_per_m = 0;  ///< d heading / d distance; positive turns left
};

/// A corner of a polyline and the radius that rounds it; the ends' radii are ignored.
struct Waypoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double corner_radius_m = 0;
};

/// A curve of lines and circular arcs, parameterised by arc length: position and heading are
/// continuous, curvature is constant on each segment.
class Path {
 public:
  /// One line (curvature 0) or arc. A line may turn at its start only where the path was built
  /// with a corner of radius 0.
  struct Segment {
    double start_m = 0;   ///< arc length at which it begins
    double length_m = 0;  ///< > 0
    PathPoint start;
    int side = 0;  ///< index of the polyline's side it belongs to; an arc belongs to the one before
  };

  /// Rounds the polyline's corners by arcs tangent to both sides. Throws std::invalid_argument when
  /// there are fewer than two points, two neighbours coincide, a path turns back on itself, or the
  /// arcs of neighbouring corners overlap (the message names the waypoint's index).
  static Path Through(std::span<const Waypoint> waypoints);

  double length_m() const { return length_m_; }
  const std::vector<Segment>& segments() const { return segments_; }
  /// The point at a distance from the start, clamped to [0, length_m()].
  PathPoint At(double distance_m) const;

 private:
  void Append(const PathPoint& start, double length_m, std::size_t side);

  std::vector<Segment> segments_;
  double length_m_ = 0;
};

/// `angle` brought to (-pi, pi].
double WrapAngle(double angle);

}  // namespace aisle::sim
