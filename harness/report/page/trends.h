#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/record/history.h"
#include "harness/report/page/verdict_section.h"

namespace aisle {

/// Where the page of trends stands and what leads on from it.
struct TrendPlace {
  std::filesystem::path history_dir =
      {};                          ///< folder of the history file, whose nights lie below it
  std::string to_history = "../";  ///< leads from the page to that folder
  std::string suite_file = {};     ///< for command lines; empty: not known
};

/// How the suite fared from night to night: what changed and since when, in words; then a chart per
/// scene, twin and score, with quartiles, limits and failed nights, each point leading to its
/// night. Empty below two nights.
std::string TrendSection(const std::vector<TrendPoint>& points, const TrendPlace& place);

/// For the verdicts of the last night: since when each changed score is as it is, leading to its
/// chart on `trends.html`.
SinceNotes SinceWhen(const std::vector<TrendPoint>& points);

/// The same in plain words, what fails first: "paper/one live robust: ATE RMSE from 2.0 to 4.1 cm
/// since 2026-01-12 (commit abc)".
std::vector<std::string> ChangesInWords(const std::vector<TrendPoint>& points);

}  // namespace aisle
