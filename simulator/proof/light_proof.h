#pragma once

#include <array>

#include "simulator/proof/proofs.h"
#include "simulator/studio.h"

namespace aisle::sim {

/// The light of a moment's left image beside path tracing with `samples` paths a pixel, both before
/// the sensor, compared at a size reduced by a whole factor. Throws std::runtime_error where the
/// scene has beams or panes, which the path tracer does not draw.
LightCheck CheckLight(const Studio& studio, const Moment& moment, int samples, int reduce);

/// The same of the first of two moments, and how the light changes to the second. The paths of both
/// have the same seeds.
LightChangeCheck CheckLightChange(const Studio& studio, const std::array<Moment, 2>& moments,
                                  int samples, int reduce);

}  // namespace aisle::sim
