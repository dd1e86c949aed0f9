#include "simulator/scene/check_zones.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

namespace aisle::sim {
namespace {

using Outline = std::vector<Eigen::Vector2d>;
using Area = Eigen::AlignedBox2d;

Outline OutlineAt(const RouteState& state, const Outline& footprint) {
  const Eigen::Rotation2Dd turned(state.heading_rad);
  Outline outline;
  for (const Eigen::Vector2d& corner : footprint)
    outline.push_back(state.position + turned * corner);
  return outline;
}

/// Whether a line has a point in an area.
bool Meets(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Area& area) {
  double enters = 0, leaves = 1;  // shares of the line
  for (int axis = 0; axis < 2; ++axis) {
    const double along = to[axis] - from[axis];
    if (along == 0) {
      if (from[axis] < area.min()[axis] || from[axis] > area.max()[axis]) return false;
      continue;
    }
    const auto [first, last] = std::minmax(
        {(area.min()[axis] - from[axis]) / along, (area.max()[axis] - from[axis]) / along});
    enters = std::max(enters, first);
    leaves = std::min(leaves, last);
  }
  return enters <= leaves;
}

/// Whether a polygon holds a point, by the sides that a ray from there crosses.
bool Holds(const Outline& outline, const Eigen::Vector2d& point) {
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d &a = outline[i], &b = outline[(i + 1) % outline.size()];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    const double at_x = a.x() + (b.x() - a.x()) * (point.y() - a.y()) / (b.y() - a.y());
    if (point.x() < at_x) inside = !inside;
  }
  return inside;
}

bool IsIn(const Area& area, const Outline& outline) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    if (Meets(outline[i], outline[(i + 1) % outline.size()], area)) return true;
  }
  return Holds(outline, area.min());  // all of it or nothing
}

/// A stretch of the way on which the vehicle is in a zone: from just before to just behind it.
struct Visit {
  RouteState enters, fastest, leaves;
};

/// The first visit that breaks a zone's rule.
std::optional<Visit> FirstBreak(const Route& way, const Outline& footprint, const ZoneSpec& zone) {
  constexpr double kStep_s = 0.02;
  constexpr double kTooFast_mps = 0.01;  // less than a drive is forgiven (harness/loop)
  const Area area(zone.from.cwiseMin(zone.to), zone.from.cwiseMax(zone.to));
  const auto breaks = [&](const Visit& visit) {
    return zone.speed_mps == 0 || std::abs(visit.fastest.speed_mps) > zone.speed_mps + kTooFast_mps;
  };
  std::optional<Visit> visit;
  RouteState before = way.At(0);
  for (double t = 0; t < way.duration_s() + kStep_s; t += kStep_s) {
    const RouteState state = way.At(t);
    const bool is_in = IsIn(area, OutlineAt(state, footprint));
    if (is_in && !visit) visit = Visit{before, state, state};
    before = state;
    if (visit) visit->leaves = state;
    if (!is_in) {
      if (visit && breaks(*visit)) return visit;
      visit.reset();
      continue;
    }
    if (std::abs(state.speed_mps) > std::abs(visit->fastest.speed_mps)) visit->fastest = state;
  }
  return visit && breaks(*visit) ? visit : std::nullopt;
}

std::string Text(const Eigen::Vector2d& place) {
  return fmt::format("[{:.2f}, {:.2f}]", place.x(), place.y());
}

}  // namespace

void CheckZones(const Scene& scene, Issues* issues) {
  const RouteSpec& route = scene.rig.route;
  if (scene.drive.zones.empty()) return;
  const Route way(route.plan, route.limits);
  for (std::size_t i = 0; i < scene.drive.zones.size(); ++i) {
    const ZoneSpec& zone = scene.drive.zones[i];
    const std::optional<Visit> visit = FirstBreak(way, scene.drive.footprint, zone);
    if (!visit) continue;
    const int step = visit->fastest.step;
    const bool in_step = step >= 0 && static_cast<std::size_t>(step) < route.marks.size();
    const std::string where =
        fmt::format("from {} to {} on its way its outline is in drive.zones[{}] ({})",
                    Text(visit->enters.position), Text(visit->leaves.position), i, zone.name);
    const std::string what =
        zone.speed_mps == 0 ? "which is closed to vehicles (speed_mps: 0): route it round the "
                              "zone, or give the zone a speed"
                            : fmt::format(
                                  "where {0:g} m/s is the limit, but it goes {1:.3g} m/s at {2}: "
                                  "end a step at both places and set speed_mps: {0:g} between them",
                                  zone.speed_mps, std::abs(visit->fastest.speed_mps),
                                  Text(visit->fastest.position));
    issues->Add(in_step ? route.marks[static_cast<std::size_t>(step)].step : route.mark,
                in_step ? fmt::format("rig.steps[{}]", step) : "rig.start", where + ", " + what);
  }
}

}  // namespace aisle::sim
