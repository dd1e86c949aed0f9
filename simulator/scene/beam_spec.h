#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "simulator/motion/joint.h"
#include "simulator/scene/given_key.h"
#include "simulator/scene/kinds.h"
#include "simulator/scene/mark.h"

namespace aisle::sim {

enum class BeamKind {
  kSpot,  ///< a lamp that turns: light in a cone
  kSun,   ///< sunlight through a window: light in a prism
};

/// Begin at a time to be otherwise, and be so a while later.
struct SunMove {
  double at_s = 0;
  double over_s = 1;
  double azimuth_rad = 0, elevation_rad = 0;
  double share = 1;  ///< of its light that clouds leave
};

/// A light that moves though nothing else does. Angles are radians here and degrees in the file.
struct BeamSpec {
  Mark mark;
  std::string name;
  BeamKind kind = BeamKind::kSpot;
  Dynamics level = Dynamics::kLow;
  Eigen::Vector3d at = {0, 0, 2};  ///< a spot; the middle of a window
  double brightness = 1;           ///< spot: intensity; sun: irradiance across its rays
  double azimuth_rad = 0;          ///< spot: where it shines at first; sun: where the sun stands
  double elevation_rad = 0;        ///< likewise, over the horizon
  double width_rad = 0.5;          ///< spot: across the whole cone
  double rate_rad_s = 0;           ///< spot: turning about the plumb line
  RunTimes run;
  Eigen::Vector2d size_m = {2, 1.5};  ///< window: width and height
  double facing_rad = 0;              ///< window: its normal's azimuth, into the hall
  bool is_roof = false;               ///< window: it lies in the roof instead
  int columns = 3, rows = 2;          ///< window: panes
  double bar_m = 0.06;                ///< window: bars between them
  std::vector<SunMove> moves;
  std::vector<GivenKey> given;  ///< of the keys that are of one kind
};

}  // namespace aisle::sim
