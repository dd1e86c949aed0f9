#pragma once

#include "simulator/proof/proofs.h"
#include "simulator/studio.h"

namespace aisle::sim {

/// Holds the truth of a moment against an independent rasteriser, and against itself by warping it
/// to the right camera and to the next moment's left one. Of pictures nothing is said.
VerifyReport ProveTruth(const Studio& studio, const Moment& now, const Moment& next);

}  // namespace aisle::sim
