#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "simulator/motion/clothoid.h"
#include "simulator/motion/corner.h"

namespace aisle::sim {

/// A curve of lines, circular arcs and clothoids, parameterised by arc length: position and heading
/// are continuous, and so is curvature where every corner's sharpness is finite.
class Path {
 public:
  /// A stretch along which curvature changes evenly: a line (0 throughout), an arc (constant) or a
  /// clothoid.
  struct Segment {
    double start_m = 0;   ///< arc length at which it begins
    double length_m = 0;  ///< > 0
    PathPoint start;
    double sharpness_per_m2 = 0;  ///< d curvature / d distance
    int side =
        0;  ///< index of the polyline's side it belongs to; a corner belongs to the one before

    bool IsLine() const { return start.curvature_per_m == 0 && sharpness_per_m2 == 0; }
  };

  struct Arc {
    double length_m = 0;  ///< >= 0
    double curvature_per_m = 0;
  };

  /// Rounds the polyline's corners by curves tangent to both sides. Throws std::invalid_argument
  /// when there are fewer than two points, two neighbours coincide, a path turns back on itself, or
  /// the curves of neighbouring corners overlap (the message names the waypoint's index).
  static Path Through(std::span<const Waypoint> waypoints);

  double length_m() const { return length_m_; }
  /// Arcs one after another, each tangent to the one before; none of no length.
  static Path OfArcs(PathPoint start, std::span<const Arc> arcs);

  const std::vector<Segment>& segments() const { return segments_; }
  /// The point at a distance from the start, clamped to [0, length_m()].
  PathPoint At(double distance_m) const;

 private:
  PathPoint Append(const PathPoint& start, double sharpness_per_m2, double length_m,
                   std::size_t side);
  void AppendCorner(PathPoint start, const CornerShape& shape, std::size_t side);

  std::vector<Segment> segments_;
  double length_m_ = 0;
};

}  // namespace aisle::sim
