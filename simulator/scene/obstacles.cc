#include "simulator/scene/obstacles.h"

#include <fmt/format.h>

#include <cmath>

#include "simulator/scene/fixture.h"

namespace aisle::sim {

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
    obstacles.push_back({fmt::format("fixtures[{}]", i), fixture.at, SizeOf(fixture).head<2>() / 2,
                         fixture.heading_rad});
  }
  return obstacles;
}

}  // namespace aisle::sim
