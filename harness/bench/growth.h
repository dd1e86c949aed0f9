#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/plugs/render_cost.h"

namespace aisle {

/// One hall with people and vehicles at work before the camera, made by program: fewer actors are
/// the first ones of more.
struct GrowthScene {
  int actors = 0;       ///< 0 to 12
  int rack_levels = 3;  ///< 0: a bare hall; what is static, and its triangles, grow with them
  int width = 752, height = 480;  ///< pixels; the view stays as wide
  int frames = 8;                 ///< one after the other, at 20 Hz

  bool operator==(const GrowthScene&) const = default;
};
inline constexpr int kMostGrowthActors = 12;

/// The scene file. Throws std::invalid_argument for more actors than there are.
std::string GrowthSceneText(const GrowthScene& scene);

struct GrowthRow {
  GrowthScene scene;
  int threads = 1;
  RenderCost cost;
  double of_none = 1;  ///< the pair's time over that of the same scene without actors
};

struct GrowthOptions {
  int frames = 8;  ///< a row, and one before them that does not count
  int threads = 2;
  /// How much further apart than usual the points of the static light lie: it is solved for each
  /// hall, and what a frame costs hardly depends on it.
  double light_spacing = 4;
  std::string assets_dir, isa = "avx2";
};

/// A hall, a picture and a number of threads, and the numbers of actors that are measured there;
/// 0 is the first.
struct GrowthSeries {
  GrowthScene scene;
  int threads = 1;
  std::vector<int> actors;
};

/// What is measured: actors one by one, then more of everything else, each with none and with many.
std::vector<GrowthSeries> GrowthPlan(const GrowthOptions& options);

/// Renders all of it. `measured` is told each row as it comes.
std::vector<GrowthRow> MeasureGrowth(const GrowthOptions& options,
                                     const std::function<void(const GrowthRow&)>& measured = {});

/// A row a line, with the heading.
std::string GrowthTable(const std::vector<GrowthRow>& rows);

/// What a pair takes on some number of threads.
struct ThreadTime {
  int threads = 1;
  double ms = 0;
};

/// The law of Amdahl (1967) through such times: waiting for memory counts as serial work.
struct ScalingFit {
  double serial_share =
      0;                ///< of the work, done one after the other; below 0 faster than all cores
  double residual = 0;  ///< of the times over the law, standard deviation
};

/// The fit with the least relative error. None of less than three numbers of threads: the law has
/// two parameters, so that any two times lie on it.
std::optional<ScalingFit> FitScaling(const std::vector<ThreadTime>& times);

/// How many times as fast as on one thread it is then on more.
double SpeedUp(double serial_share, int threads);

/// For each number of actors that was measured on one thread and on several, how the times compare;
/// and where there are three numbers of threads or more, beneath it what the law makes of machines
/// with more cores ("-" where the share is not positive: then they tell nothing about it). Empty
/// where nothing was measured on one thread and on several.
std::string ScalingTable(const std::vector<GrowthRow>& rows);

}  // namespace aisle
