#pragma once

#include <string>
#include <vector>

#include "simulator/motion/route.h"

namespace aisle::sim {

/// What a mover covers of the floor: all within radius_m of a line along its heading.
struct Footprint {
  double back_m = 0,
         front_m = 0;  ///< ends of the line, ahead of the mover's origin
  double radius_m = 0;
};

/// A vehicle's as it is modelled, mirrors and counterweights left out.
Footprint FootprintOf(const std::string& model);

// What people and the rig take up, as radii around their origin. What runs into something is
// narrower than what others keep away from.
/// Nobody is taller: what hangs higher is in nobody's way.
inline constexpr double kHead_m = 1.8;
/// A person's body, arms at rest: what may not touch shelves, nor anybody else.
inline constexpr double kPersonHalfWidth_m = 0.22;
/// With elbows and swinging arms: what a crowd and a vehicle leave to somebody.
inline constexpr double kPersonReach_m = 0.25;
/// The rig's vehicle, half its width.
inline constexpr double kRigHalfWidth_m = 0.3;
/// Half its length, around its middle: what a crowd leaves to it whichever way it turns.
inline constexpr double kRigBerth_m = 0.45;

/// How far ahead of the person at its handle the origin of a vehicle is that is pushed: as the
/// assets have it, to 6 cm, since arms differ in length.
double AheadOfPusher(const std::string& model);

/// Middles of discs of the footprint's radius that cover it, ahead of a point that is `origin_m`
/// behind the mover's origin.
std::vector<double> DiscsAlong(const Footprint& footprint, double origin_m);

/// How far two footprints' lines are apart, metres.
double Apart(const Footprint& one, const RouteState& one_at, const Footprint& other,
             const RouteState& other_at);

}  // namespace aisle::sim
