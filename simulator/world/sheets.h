#pragma once

#include <opencv2/core.hpp>

#include "simulator/scene/dice.h"
#include "simulator/scene/scene.h"

namespace aisle::sim {

// What happens to surfaces where people work: painted from a stream of numbers each, so that no two
// seeds share a floor. Grey, sRGB-encoded.

/// The picture as the thing is after months, not decades: greys within `limit` of the median keep
/// `share` of their distance from it, the rest moves along, so that prints, cracks and joints stay
/// while mottle and blotches fade. Measured: the authored sheets have about twice the contrast of
/// floors, boards and walls in real pictures.
cv::Mat1b Plainer(const cv::Mat1b& picture, float share, int limit);

/// A floor picture with stains, tyre marks, chips and joints of its own; `wear` in [0, 1].
cv::Mat1b WornFloor(const cv::Mat1b& clean, Dice dice, double wear);
/// Floor paint rubbed off in places.
cv::Mat1b LinePaintSheet(Dice dice, double wear);
/// The same in oblique stripes.
cv::Mat1b HatchSheet(Dice dice, double wear);

}  // namespace aisle::sim
