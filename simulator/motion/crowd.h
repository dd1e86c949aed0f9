#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "simulator/motion/route.h"

namespace aisle::sim {

/// A crowd's clock.
inline constexpr double kCrowdStep_s = 0.1;

/// A rectangle of the floor, turned; nobody walks there.
struct CrowdBlock {
  Eigen::Vector2d center = Eigen::Vector2d::Zero(), half = Eigen::Vector2d::Zero();
  double heading_rad = 0;
};

/// Who does not give way: the rig, vehicles, people of the script.
struct CrowdIntruder {
  std::vector<Eigen::Vector2d> places;  ///< one every kCrowdStep_s from time 0; not empty
  double radius_m = 0.3;

  /// At a time, to the nearest step; it stays where it is last.
  const Eigen::Vector2d& At(double time_s) const {
    const auto step = static_cast<std::size_t>(std::lround(std::max(0.0, time_s) / kCrowdStep_s));
    return places[std::min(step, places.size() - 1)];
  }
};

/// What the social force model needs to know. The forces' constants are those of Helbing and
/// Molnar, Social force model for pedestrian dynamics, Phys. Rev. E 51, 1995.
struct CrowdPlan {
  int people = 0;
  Eigen::Vector2d from = Eigen::Vector2d::Zero(), to = Eigen::Vector2d::Zero();  ///< where, corners
  double speed_mps = 1.34, speed_spread_mps = 0.26;
  double pause_s = 2;
  double distance_m = 0.6;  ///< middle to middle, never less
  double radius_m = 0.3;    ///< from a middle to blocks, to the border, and to intruders' own
  double duration_s = 10;
  RouteLimits limits;  ///< of turning on the spot
  std::vector<CrowdBlock> blocks;
  std::vector<CrowdIntruder> intruders;
};

/// The ways of a crowd, precomputed: each a start and legs of arcs with evenly changing speeds, so
/// that where somebody is at a time follows in closed form. People are pulled to goals at the speed
/// they like and pushed off by others, by what stands and by who does not give way; they walk ahead
/// only and turn as people do (the headed model: Farina, Fontanelli, Garulli, Giannitrapani and
/// Prattichizzo, Walking ahead, PLoS ONE 12, 2017).
///
/// Nobody comes nearer to another than distance_m, by induction and not by force: a step is taken
/// only if all could brake after it without meeting, and who finds none brakes. Seeded; the same
/// bits for the same plan and seed. Throws std::invalid_argument when there is no room for so many,
/// or an intruder runs into somebody in each of 24 attempts.
std::vector<RoutePlan> WalkCrowd(const CrowdPlan& plan, std::uint64_t seed);

}  // namespace aisle::sim
