#pragma once

#include <functional>
#include <string>
#include <vector>

#include "harness/report/page/night_series.h"

namespace aisle {

/// Leads from the page to a night; empty where it cannot be led to.
using NightLink = std::function<std::string(const Night&)>;

/// Whether there is a number to draw.
bool HasTrendChart(const std::vector<const NightSeries*>& systems,
                   const std::vector<Night>& nights);

/// One score of several systems over the nights: medians with their quartiles as a band, limits
/// dashed, a cross where runs failed: at the top, and in a gap of the line, where a system that was
/// driven has no number. Empty unless HasTrendChart.
std::string TrendChart(const std::vector<const NightSeries*>& systems,
                       const std::vector<Night>& nights, const NightLink& link);

}  // namespace aisle
