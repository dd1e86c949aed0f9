#include "harness/loop/scanner.h"

#include <algorithm>

namespace aisle {

namespace {

Polygon Rectangle(const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  return {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
}

}  // namespace

Polygon ProtectiveField(const Polygon& footprint, double speed_mps, const PlantOptions& plant,
                        const ScannerOptions& options) {
  const auto [low, high] = BoxOf(footprint);
  const double length =
      std::abs(speed_mps) * options.reaction_s + StoppingWay(speed_mps, plant) + options.margin_m;
  const double from = speed_mps < 0 ? low.x() - length : high.x();
  const double to = speed_mps < 0 ? low.x() : high.x() + length;
  const double right = low.y() - options.side_m, left = high.y() + options.side_m;
  return Rectangle({from, right}, {to, left});
}

Polygon TurningField(const Polygon& footprint, const ScannerOptions& options) {
  const auto [low, high] = BoxOf(footprint);
  const Eigen::Vector2d wider(options.margin_m, options.side_m);
  return Rectangle(low - wider, high + wider);
}

bool IsBlocked(const Course& course, const FloorPose& vehicle, const Polygon& field,
               const std::vector<Capsule>& actors) {
  const Polygon placed = At(vehicle, field);
  const double reach = ReachOf(field);
  const auto blocks = [&](const Capsule& actor) { return Distance(placed, actor) <= 0; };
  if (std::ranges::any_of(actors, blocks)) return true;
  return std::ranges::any_of(course.things, [&](const StandingThing& thing) {
    const auto [low, high] = BoxOf(thing.outline);
    const Eigen::Vector2d& at = vehicle.position;
    const double off = (low - at).cwiseMax(at - high).cwiseMax(Eigen::Vector2d::Zero()).norm();
    return off <= reach && Distance(placed, thing.outline) <= 0;
  });
}

}  // namespace aisle
