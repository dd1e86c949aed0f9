#pragma once

#include <functional>
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

/// The share of a pair's work that is done one after the other, so that it takes `one_ms` on one
/// thread and `many_ms` on several (Amdahl 1967); waiting for memory counts as such. In [0, 1].
double SerialShare(double one_ms, double many_ms, int threads);
/// How many times as fast it is then on more threads.
double SpeedUp(double serial_share, int threads);

/// For each number of actors that was measured on one thread and on several: the serial share, and
/// what follows from it for machines with more cores, one run on all of them or runs of four
/// threads beside each other. Empty where there is none.
std::string ScalingTable(const std::vector<GrowthRow>& rows);

}  // namespace aisle
