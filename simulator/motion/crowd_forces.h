#pragma once

#include "simulator/motion/crowd.h"

namespace aisle::sim {

/// The forces of Helbing and Molnar 1995 on a body of mass 1: accelerations, m/s².

struct BodyNow {
  Eigen::Vector2d position;
  double heading_rad = 0;
  double speed_mps = 0;

  Eigen::Vector2d ahead() const { return {std::cos(heading_rad), std::sin(heading_rad)}; }
  Eigen::Vector2d velocity() const { return speed_mps * ahead(); }
};

/// Equation (2): to the wanted velocity within a relaxation time.
Eigen::Vector2d GoalForce(const BodyNow& body, const Eigen::Vector2d& way, double wanted_mps);

/// Equations (3), (4) and (8): off the ellipse that another's next step spans; who is behind
/// counts half.
Eigen::Vector2d PersonForce(const BodyNow& body, const BodyNow& other);

/// Equation (5): off the nearest point of a border.
Eigen::Vector2d BorderForce(const Eigen::Vector2d& nearest, const Eigen::Vector2d& at);

/// Off the way of one who does not give way: aside, the stronger the sooner it comes.
Eigen::Vector2d IntruderForce(const BodyNow& body, const CrowdIntruder& intruder, double time_s);

/// The point of a block nearest to a place, and how far it is; 0 within.
Eigen::Vector2d NearestOf(const CrowdBlock& block, const Eigen::Vector2d& at);
double DistanceTo(const CrowdBlock& block, const Eigen::Vector2d& at);

}  // namespace aisle::sim
