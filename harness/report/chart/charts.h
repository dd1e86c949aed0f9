#pragma once

#include <string>
#include <vector>

#include "harness/record/frames_csv.h"

namespace aisle {

/// One system's line in the charts of a scene.
struct ChartSeries {
  std::string name;
  int color = 0;  ///< CSS class "c0", "c1", …: the style sheet knows light and dark
  const std::vector<FrameRow>* rows = nullptr;
};

/// The rows of the series that got farthest; null where none has two.
const std::vector<FrameRow>* Longest(const std::vector<ChartSeries>& series);

// Inline SVG without styles or scripts of its own: classes only, so that one style sheet serves
// light and dark and the page's policy may forbid everything else.

enum class TrackKind { kLive, kFinal };
/// Truth and every track of that kind from above, the plane of greatest extent, equal scales. Where
/// deviations are too small to be seen they are drawn magnified, and the caption says how much.
std::string TopViewChart(const std::vector<ChartSeries>& series, TrackKind kind = TrackKind::kLive);

struct StageBar {
  std::string name;
  int color = 0;
  double ms = 0;
};
struct StageRow {
  std::string system;
  std::vector<StageBar> bars;
};
/// Mean time per frame by stage, a bar per system.
std::string StageChart(const std::vector<StageRow>& rows);

struct SpreadRow {
  std::string system;
  int color = 0;
  std::vector<double> values;  ///< one per seed
};
/// A dot per seed over a box of the quartiles, the median as a line: what a single run could have
/// said.
std::string SpreadChart(const std::vector<SpreadRow>& rows, const std::string& axis);

}  // namespace aisle
