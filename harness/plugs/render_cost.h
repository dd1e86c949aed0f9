#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <utility>
#include <vector>

#include "harness/plugs/simulated_sequence.h"

namespace aisle {

/// What rendering a scene costs, beside the bare primary rays of the same images in the same
/// process. Medians over `frames`, milliseconds.
struct RenderCost {
  double pair_ms = 0;          ///< a stereo pair with all truth, the drive's last frame before it
  double after_jump_ms = 0;    ///< one that comes after a jump to another place of the drive
  double bare_primary_ms = 0;  ///< primary ray packets of the same two images alone
  double ratio = 0;            ///< pair_ms / bare_primary_ms
  int frames = 0;
  std::int64_t triangles = 0, moving_triangles = 0;      ///< of the world; the movers' among them
  std::vector<std::pair<std::string, double>> stage_ms;  ///< dearest first
};

/// Times `frames` frames spread over the scene. Throws InputError for a bad scene.
RenderCost MeasureRender(const SimulatedSequenceOptions& options, int frames);

}  // namespace aisle
