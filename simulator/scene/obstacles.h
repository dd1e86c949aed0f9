#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "simulator/scene/scene.h"

namespace aisle::sim {

/// A rectangle on the floor that nobody can pass.
struct Obstacle {
  std::string name;
  Eigen::Vector2d center;
  Eigen::Vector2d half;
  double heading_rad = 0;

  double DistanceTo(const Eigen::Vector2d& point) const {
    const Eigen::Vector2d local = Eigen::Rotation2Dd(-heading_rad) * (point - center);
    return (local.cwiseAbs() - half).cwiseMax(0).norm();
  }
};

/// What stands in a scene's hall, as its routes, crowds and clutter must go round it: racks,
/// stacks, columns, fixtures that block, a mezzanine's columns and stair, models of the kit. Not
/// what moves, nor meshes of the user's own.
std::vector<Obstacle> ObstaclesOf(const Scene& scene);

}  // namespace aisle::sim
