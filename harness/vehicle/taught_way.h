#pragma once

#include <vector>

#include "harness/vehicle/way.h"

namespace aisle {

/// Where the vehicle was at one frame while it was led along its way, and where its SLAM, its map
/// finished, says that it was.
struct TaughtPose {
  FloorPose led;   ///< true, of the site
  FloorPose said;  ///< in the map, joined to the site at the start
  bool operator==(const TaughtPose&) const = default;
};

/// A way as the map has it: what the SLAM said while the vehicle was led along `planned`, so that
/// who drives by the same map errs where the teaching erred, and arrives (teach and repeat: Furgale
/// and Barfoot 2010). A map that is 0.1 % too long puts a goal 20 m away 2 cm beside itself; the
/// taught goal is 2 cm beside itself too.
///
/// Every point of the way is moved by what the SLAM was off where the vehicle was next to it, in
/// their order: a way that comes by one place twice has been taught twice. `poses` are by time;
/// speeds and curvatures stay as planned, distances are of the new points. Without poses:
/// `planned`.
Way TaughtWay(const Way& planned, const std::vector<TaughtPose>& poses);

}  // namespace aisle
