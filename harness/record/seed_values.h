#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/record/record.h"

namespace aisle {

/// A score of a run; empty where the run has none, or none with a value.
std::optional<double> ValueOf(const RunRecord& run, const std::string& score);

/// A score by seed: of a seed that ran several times, the median of its repeats. These show how a
/// system scatters by itself, and are no seeds of their own.
using ValuesBySeed = std::map<std::uint64_t, double>;

/// Of the runs of one scene and twin that have a value; `unit` becomes the score's where one has.
ValuesBySeed ValuesOf(const std::vector<const RunRecord*>& runs, const std::string& score,
                      std::string* unit);

std::vector<double> Plain(const ValuesBySeed& values);

/// The same of runs of several scenes, each with seeds of its own: a value for every seed of which
/// any run has one.
std::vector<double> MediansBySeed(
    const std::vector<const RunRecord*>& runs,
    const std::function<std::optional<double>(const RunRecord&)>& value_of);

/// How many different seeds ran, each scene and twin having its own.
std::size_t CountSeeds(const std::vector<const RunRecord*>& runs);

}  // namespace aisle
