#pragma once

#include <functional>

namespace aisle::sim {

/// How far the solution of a static light is.
struct LightProgress {
  const char* phase = "";  ///< what is at work, for people: "direct light"
  double share = 0;        ///< of the whole that is done, 0 to 1, about evenly in time
};

/// Told while a light is solved; from any thread, one call at a time. What it throws ends the work.
using TellLight = std::function<void(const LightProgress&)>;

}  // namespace aisle::sim
