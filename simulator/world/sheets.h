#pragma once

#include <opencv2/core.hpp>

#include "simulator/scene/scene.h"
#include "simulator/world/dice.h"

namespace aisle::sim {

// The pictures of the warehouse kit, painted from a stream of numbers each. Grey, sRGB-encoded.

/// A cast concrete slab: clouds, grain, stains, tyre marks, cracks, a joint along two borders.
cv::Mat1b FloorSheet(Dice dice, FloorKind kind, double wear);
/// Wall cladding: ribbed panels, bricks or plain plaster, with dirt towards the foot.
cv::Mat1b WallSheet(Dice dice, WallKind kind);
/// Corrugated roof.
cv::Mat1b RoofSheet(Dice dice);
/// Sixteen pictures of carton sides and tops, four by four.
cv::Mat1b CartonSheet(Dice dice);
/// Sixteen signs, four by four.
cv::Mat1b SignSheet(Dice dice);
cv::Mat1b WoodSheet(Dice dice);
cv::Mat1b UprightSheet(Dice dice);
cv::Mat1b BeamSheet(Dice dice);
cv::Mat1b SteelSheet(Dice dice);
cv::Mat1b WrapSheet(Dice dice);
cv::Mat1b DrumSheet(Dice dice);
cv::Mat1b ToteSheet(Dice dice);
cv::Mat1b StripeSheet(Dice dice);
cv::Mat1b LinePaintSheet(Dice dice, double wear);
cv::Mat1b HatchSheet(Dice dice, double wear);
cv::Mat1b DoorSheet(Dice dice);

}  // namespace aisle::sim
