#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "harness/record/record.h"

namespace aisle {

/// A score by seed: of a seed that ran several times, the median of its repeats.
using ValuesBySeed = std::map<std::uint64_t, double>;

/// Of the runs that have a value; `unit` becomes the score's where one has.
ValuesBySeed ValuesOf(const std::vector<const RunRecord*>& runs, const std::string& score,
                      std::string* unit);

std::vector<double> Plain(const ValuesBySeed& values);

}  // namespace aisle
