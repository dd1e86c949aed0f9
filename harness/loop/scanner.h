#pragma once

#include <vector>

#include "harness/loop/drive_scene.h"

namespace aisle {

/// A safety scanner: stops the vehicle while anything stands in the field before it, as long as the
/// way in which it can stop (ISO 3691-4 asks that much; how the field is laid out is ours).
struct ScannerOptions {
  double reaction_s = 0.15;
  double margin_m = 0.1;       ///< beyond the stopping way
  double side_m = 0.05;        ///< to both sides of the footprint
  double restart_mps = 0.3;    ///< the field of this speed must be clear to go on
  double restart_rad_s = 0.3;  ///< the same of a turn on the spot
  double clear_s = 1;          ///< for so long
};

/// The field in the vehicle's frame for a speed, backwards negative: as long as reaction v, the
/// stopping way (v^2 / 2a and what the brakes' lag adds) and margin, as wide as the footprint and
/// both sides.
Polygon ProtectiveField(const Polygon& footprint, double speed_mps, const PlantOptions& plant,
                        const ScannerOptions& options);

/// The field of a vehicle that turns on the spot, at one of its headings: its footprint, wider by
/// margin ahead and behind and by side to the sides.
Polygon TurningField(const Polygon& footprint, const ScannerOptions& options);

/// Whether anything is in the field of a vehicle at that pose.
bool IsBlocked(const Course& course, const FloorPose& vehicle, const Polygon& field,
               const std::vector<Capsule>& actors);

}  // namespace aisle
