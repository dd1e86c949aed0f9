#pragma once

#include <string>
#include <vector>

#include "harness/contract/run.h"

namespace aisle {

/// What making these runs will take, before hours of work begin.
struct Forecast {
  std::size_t scenes = 0, twins = 0, systems = 0, seeds = 0, runs = 0;
  std::size_t renders = 0;         ///< scene, twin and seed: what is rendered once for all systems
  std::int64_t pairs = 0;          ///< stereo pairs to render
  std::int64_t system_frames = 0;  ///< frames that systems are driven through
  double wall_s = 0;       ///< on this machine's cores; a guess, right within a factor of two
  double cache_bytes = 0;  ///< of kept frames, of which the newest 12 GiB stay
};

/// Frames of a scene as written, by its file. Throws InputError for a bad scene.
using CountFrames = std::function<std::int64_t(const std::string& scene_file)>;

Forecast ForecastOf(const std::vector<RunSpec>& specs, int cores, const CountFrames& count_frames);

/// "5 scenes x 2 twins x 5 systems x 9 seeds = 450 runs; 54,000 pairs to render, …".
std::string ToText(const Forecast& forecast);

}  // namespace aisle
