#include "simulator/scene/obstacles.h"

#include <fmt/format.h>

#include <cmath>

#include "simulator/scene/fixture.h"
#include "simulator/scene/mezzanine.h"
#include "simulator/scene/prop.h"

namespace aisle::sim {
namespace {

/// A rectangle of a thing's own frame, as it stands.
Obstacle Placed(std::string name, const Eigen::AlignedBox2d& own, const Eigen::Vector2d& at,
                double heading_rad) {
  return {std::move(name), at + Eigen::Rotation2Dd(heading_rad) * own.center(), own.sizes() / 2,
          heading_rad};
}

void AddMezzanine(const MezzanineSpec& mezzanine, std::size_t index,
                  std::vector<Obstacle>* obstacles) {
  const MezzanineFeet feet = FeetOf(mezzanine);
  const double half = MezzanineFeet::kColumn_m / 2;
  for (const float x : feet.xs) {
    for (const float y : feet.ys) {
      obstacles->push_back(
          {fmt::format("a column of mezzanines[{}]", index), {x, y}, {half, half}, 0});
    }
  }
  constexpr double kString_m = 0.035;
  const Eigen::Vector2d half_stair(MezzanineFeet::kStairHalfWidth_m + kString_m,
                                   feet.stair_run_m() / 2 + kString_m);
  obstacles->push_back({fmt::format("the stair of mezzanines[{}]", index),
                        feet.stair_top.cast<double>() - Eigen::Vector2d(0, feet.stair_run_m() / 2),
                        half_stair, 0});
}

}  // namespace

std::vector<Obstacle> ObstaclesOf(const Scene& scene) {
  std::vector<Obstacle> obstacles;
  for (std::size_t i = 0; i < scene.racks.size(); ++i) {
    const RackSpec& rack = scene.racks[i];
    const double length = rack.bays * rack.bay_m;
    const Eigen::Vector2d along(std::cos(rack.heading_rad), std::sin(rack.heading_rad));
    obstacles.push_back({fmt::format("racks[{}]", i),
                         rack.from + along * length / 2,
                         {length / 2, rack.depth_m / 2},
                         rack.heading_rad});
  }
  for (std::size_t i = 0; i < scene.stacks.size(); ++i) {
    const StackSpec& stack = scene.stacks[i];
    obstacles.push_back({fmt::format("stacks[{}]", i), stack.at, {0.6, 0.4}, stack.heading_rad});
  }
  for (std::size_t i = 0; i < scene.columns.size(); ++i) {
    const ColumnSpec& column = scene.columns[i];
    const double half = column.size_m / 2;
    obstacles.push_back({fmt::format("columns[{}]", i), column.at, {half, half}, 0});
  }
  for (std::size_t i = 0; i < scene.fixtures.size(); ++i) {
    const FixtureSpec& fixture = scene.fixtures[i];
    if (!Blocks(fixture)) continue;
    obstacles.push_back(Placed(fmt::format("fixtures[{}]", i), FootprintOf(fixture), fixture.at,
                               fixture.heading_rad));
  }
  for (std::size_t i = 0; i < scene.mezzanines.size(); ++i) {
    AddMezzanine(scene.mezzanines[i], i, &obstacles);
  }
  for (std::size_t i = 0; i < scene.props.size(); ++i) {
    const PropSpec& prop = scene.props[i];
    const std::optional<Eigen::AlignedBox2d> footprint = FootprintOf(prop);
    if (!footprint) continue;
    for (const Eigen::Vector2d& at : PlacesOf(prop)) {
      obstacles.push_back(Placed(fmt::format("props[{}]", i), *footprint, at, prop.heading_rad));
    }
  }
  return obstacles;
}

}  // namespace aisle::sim
