#pragma once

#include <string>
#include <vector>

#include "harness/record/frames_csv.h"

namespace aisle {

/// One system's lines in the charts of a scene.
struct ChartSeries {
  std::string name;
  int color = 0;  ///< style of StylesOf: CSS class "c0" to "c11", which knows light and dark
  const std::vector<FrameRow>* rows = nullptr;  ///< of one seed: the worst, where there are several
  std::string seed = {};                        ///< which that is; empty where there is but one
  /// Of every seed, `rows` among them; empty where there is but one.
  std::vector<const std::vector<FrameRow>*> seeds = {};
};

/// The rows of the series that got farthest; null where none has two.
const std::vector<FrameRow>* Longest(const std::vector<ChartSeries>& series);

// Inline SVG without styles or scripts of its own: classes only, so that one style sheet serves
// light and dark and the page's policy may forbid everything else.

enum class TrackKind { kLive, kFinal };
/// Truth and every track of that kind from above, the plane of greatest extent, equal scales; of
/// vehicles that were steered, each with its own truth. Where
/// deviations are too small to be seen they are drawn magnified, and the caption says how much.
std::string TopViewChart(const std::vector<ChartSeries>& series, TrackKind kind = TrackKind::kLive);

struct StageBar {
  std::string name;
  int color = 0;
  double ms = 0;  ///< a frame, on average over all frames
};
struct StageRow {
  std::string system;
  double step_ms = 0;            ///< the whole step, as the harness saw it
  std::vector<StageBar> inside;  ///< in the step; what is missing to step_ms is drawn as the rest
  std::vector<StageBar> beside;  ///< in threads of its own, beside the frames
};
/// Mean time per frame by stage: a bar per system that is as long as its step, and below it a
/// thinner one of what runs beside.
std::string StageChart(const std::vector<StageRow>& rows);

struct SpreadRow {
  std::string system;
  int color = 0;
  std::vector<double> values;  ///< one per seed, or per drive over one input
};
/// A dot per seed over a box of the quartiles, the median as a line: what a single run could have
/// said.
std::string SpreadChart(const std::vector<SpreadRow>& rows, const std::string& axis);

}  // namespace aisle
