#pragma once

#include <string>

#include "simulator/motion/route.h"

namespace aisle::sim {

/// What a mover covers of the floor: all within radius_m of a line along its heading.
struct Footprint {
  double back_m = 0, front_m = 0;  ///< ends of the line, ahead of the mover's origin
  double radius_m = 0;
};

/// A vehicle's as it is modelled, mirrors and counterweights left out.
Footprint FootprintOf(const std::string& model);

/// How far two footprints' lines are apart, metres.
double Apart(const Footprint& one, const RouteState& one_at, const Footprint& other,
             const RouteState& other_at);

}  // namespace aisle::sim
