#pragma once

#include <string>

#include "harness/campaign/job.h"

namespace aisle::test {

/// A job of a system in a scene, with nobody else's frames but those of its scene.
inline Job JobOf(const std::string& scene, const std::string& system) {
  Job job;
  job.spec = {scene, scene + ".yaml", "live", BuiltIn(system), 1};
  job.frames_key = scene;
  return job;
}

}  // namespace aisle::test
