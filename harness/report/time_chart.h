#pragma once

#include "harness/report/charts.h"

namespace aisle {

/// What happened over one drive, panel under panel on one axis of time: the live error of every
/// system, the share of pixels that move, the corners each system rejected, and how hard the frames
/// were for anybody. Panels of which nothing is known are left out; empty without two frames.
std::string TimeChart(const std::vector<ChartSeries>& series);

}  // namespace aisle
