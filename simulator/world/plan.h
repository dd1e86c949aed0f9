#pragma once

#include <opencv2/core.hpp>

#include "simulator/world/world.h"

namespace aisle::sim {

/// The layout from above, x to the right and y up, at `px_per_m`: what stands lower than a door is
/// coloured by its class, actors stand where they are at the start. The rig's way is red, with a
/// dot at its start; those of the actors are blue, with their names. `end_ns` is when ways end.
cv::Mat3b DrawPlan(const World& world, std::int64_t end_ns, double px_per_m);

}  // namespace aisle::sim
