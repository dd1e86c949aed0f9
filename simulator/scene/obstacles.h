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

/// What stands in a scene's hall, actors and props left out.
std::vector<Obstacle> ObstaclesOf(const Scene& scene);

}  // namespace aisle::sim
