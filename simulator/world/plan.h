#pragma once

#include <opencv2/core.hpp>

#include "simulator/world/world.h"

namespace aisle::sim {

/// The point (x, y) of the world, metres, is drawn at origin_px + px_per_m (x, -y).
struct PlanPicture {
  cv::Mat3b picture;
  cv::Point2d origin_px;
  double px_per_m = 1;
};

/// The layout from above, x to the right and y up, in a picture so wide, with metres along both
/// axes: what stands lower than a door is
/// coloured by its class, actors stand where they are at the start. The rig's way is red, with a
/// dot at its start; those of the actors are blue, with their names. `end_ns` is when ways end.
PlanPicture DrawPlan(const World& world, std::int64_t end_ns, int width_px);

}  // namespace aisle::sim
