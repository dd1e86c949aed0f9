#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "harness/campaign/time_left.h"
#include "harness/contract/run.h"

namespace aisle {

/// What making these runs will take, before hours of work begin.
struct Forecast {
  std::size_t scenes = 0, twins = 0, systems = 0, seeds = 0, runs = 0;
  std::int64_t pairs = 0;  ///< stereo pairs to render, less those kept; a recording has its own
  std::int64_t system_frames = 0;  ///< frames that systems are driven through
  std::size_t answered = 0;        ///< runs that another's drive answers, for equal inputs
  double wall_s = 0;       ///< on this machine's cores; a guess, right within a factor of two
  double cache_bytes = 0;  ///< of kept frames, of which the newest 12 GiB stay
};

/// What is to be known of the frames that runs are driven through.
struct FramesOfRuns {
  /// Frames of a scene as written, by its file. Throws InputError for a bad scene.
  std::function<std::int64_t(const std::string& scene_file)> count;
  /// What tells the frames of one run from another's; equal ones are rendered once, and one of our
  /// systems is driven through them once.
  std::function<std::string(const RunSpec& spec)> key;
  /// How many of them are kept from before, by their key.
  std::function<std::int64_t(const std::string& key)> kept;
  /// Whether systems steer through a scene, by its file: what they see is then theirs alone, but
  /// what a vehicle is led past when its way is taught.
  std::function<bool(const std::string& scene_file)> steered;
};

Forecast ForecastOf(const std::vector<RunSpec>& specs, int cores, const FramesOfRuns& ahead);

/// What each run is thought to take, by RunId: what it took in the report's folder the last time,
/// else by its frames and its system.
ExpectedTimes ExpectTimes(const std::vector<RunSpec>& specs, const std::filesystem::path& out,
                          const FramesOfRuns& ahead);

/// "5 scenes x 2 twins x 5 systems x 9 seeds = 450 runs; 54,000 pairs to render, …".
std::string ToText(const Forecast& forecast);

}  // namespace aisle
