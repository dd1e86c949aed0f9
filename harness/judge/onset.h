#pragma once

#include <optional>
#include <vector>

namespace aisle {

/// Since when a series of nights is other than it was.
struct Onset {
  std::size_t night = 0;         ///< the first of the new kind: an index into the series
  double before = 0, after = 0;  ///< medians of the nights before it, and of it and those since
};

/// The first night from which on every night lies beyond what the nights before it, three or more,
/// let one expect: by a tenth of their median and by four times their median deviation from it, all
/// on one side. Nights without a value are passed over. Nothing where the last night is as most of
/// those before it were: a bad night that stayed alone is no news.
std::optional<Onset> FindOnset(const std::vector<std::optional<double>>& nights);

/// The first night from which on every night failed; nothing where the last one did not.
std::optional<std::size_t> FailingSince(const std::vector<bool>& failed);

}  // namespace aisle
