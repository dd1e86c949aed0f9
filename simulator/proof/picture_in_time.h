#pragma once

#include "simulator/proof/picture_change.h"
#include "simulator/studio.h"

namespace aisle::sim {

/// The left picture of a moment, and where its points are at the next.
PictureWithFlow TakeWithFlow(const Studio& studio, const Moment& now, const Moment& next);

/// Left pictures of three moments, compared along the flow.
PictureChanges CompareInTime(const Studio& studio, const std::array<Moment, 3>& moments);

}  // namespace aisle::sim
