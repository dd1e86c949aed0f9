#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/bench/search.h"

namespace aisle {

/// What a search found, for a page.
struct SearchReport {
  std::string system;
  std::vector<SearchAxis> axes;
  OptionSet own;  ///< what the system has for them
  std::vector<Trial> trials;
  std::vector<JudgedSet> judged;  ///< the named ones and the found one, in their order
  std::vector<JudgedSet> frontier;
  double time_limit = 0;
  bool found = false;  ///< whether one of the best kept it
};

/// The first whose time, in times of tracking, keeps the limit; nothing where none does.
std::optional<std::size_t> FirstInTime(const std::vector<double>& ratios, double limit);

/// One line of a trial, for a terminal; the heading for an empty one.
std::string TrialHeading();
std::string TrialLine(const Trial& trial);

/// The tables as Markdown: the sets' constants, how they fared on the judging stretches, whole and
/// by scene, at which step large movers were lost, and the frontier.
std::string ToMarkdown(const SearchReport& report);

}  // namespace aisle
