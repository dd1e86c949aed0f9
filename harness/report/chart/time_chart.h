#pragma once

#include "harness/report/chart/charts.h"

namespace aisle {

/// What happened over one drive, panel under panel on one axis of time: the live error of every
/// system, the share of pixels that move, the corners each system rejected, and how hard the frames
/// were for anybody. Panels of which nothing is known are left out; empty without two frames.
std::string TimeChart(const std::vector<ChartSeries>& series);

/// As the paper's Fig. 9: the live error in metres over the frames, and below it what moves.
std::string ErrorOverFrames(const std::vector<ChartSeries>& series);
/// As the paper's Fig. 10: the image corners that each system rejected, and below it what moves.
std::string RejectedOverFrames(const std::vector<ChartSeries>& series);

}  // namespace aisle
