#pragma once

#include <vector>

#include "harness/contract/run.h"
#include "harness/score/masks.h"

namespace aisle {

/// How well what was rejected met what moves, over the frames whose facts were added up: shares in
/// [0, 1], each with what it counted, or why there is none.
struct Detection {
  Score precision, recall, iou;
};
/// Of pixels.
Detection PixelDetection(const MaskFacts& sum);
/// Of objects by rectangle; `iou` is the mean over those found.
Detection ObjectDetection(const MaskFacts& sum);
/// Of large movers alone (IsLargeMover), and of large regions: a wrong speck does not weigh as much
/// as a lost aisle. Without `iou`.
Detection LargeDetection(const MaskFacts& sum);

/// Of the large movers that were asked for, those found.
ObjectCount CountLargeMovers(const MaskFacts& sum);

/// mask_* over all pixels together, object_* by rectangle and by what was covered, mover_* over
/// time, static_features_lost. Nothing at all where no frame has mask facts.
void AddMasks(const std::vector<FrameFacts>& frames, Scorecard* scores);

}  // namespace aisle
