#pragma once

#include <functional>
#include <string>
#include <vector>

#include "harness/report/page/night_series.h"

namespace aisle {

/// Leads from the page to a night; empty where it cannot be led to.
using NightLink = std::function<std::string(const Night&)>;

/// One score of several systems over the nights: medians with their quartiles as a band, limits
/// dashed, a cross where runs failed. Empty where there is no number.
std::string TrendChart(const std::vector<const NightSeries*>& systems,
                       const std::vector<Night>& nights, const NightLink& link);

}  // namespace aisle
