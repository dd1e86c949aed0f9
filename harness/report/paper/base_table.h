#pragma once

#include <optional>

#include "harness/report/paper/tables.h"

namespace aisle {

/// What the tracker and what the rejection contribute: absolute error by what a system rejects and,
/// beneath it, whose decisions it tracks by; medians and, of several seeds, the least and the most.
/// Of live runs of our systems whose options are no others. Nothing unless one rejection has been
/// driven on two bases.
std::optional<NumberTable> BaseTable(const std::vector<SceneRuns>& scenes);

/// Whether it is one of ours on another base and nothing else: such a system stands in that table
/// and in no other.
bool IsOnAnotherBase(const SystemSpec& spec);

}  // namespace aisle
