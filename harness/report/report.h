#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "harness/record/history.h"
#include "harness/record/results.h"

namespace aisle {

struct ReportOptions {
  std::vector<TrendPoint> history = {};             ///< all nights of the suite, this one the last
  std::filesystem::path history_file = {};          ///< whose folder holds the nights' reports
  std::string history_trouble = {};                 ///< why the nights are not known; else empty
  std::map<std::string, std::string> systems = {};  ///< a sentence of each built-in one, by name
  std::size_t limits = 0;                           ///< that the suites set; 0: not known
};

/// Writes the pages and the machine-readable files of an evening below `report_dir`: index.html, a
/// page per scene where there are many, paper.html, trends.html from two nights on, results.json,
/// summary.csv, summary.txt, junit.xml, tables.md and tables.tex. Reads the runs' frames.csv.
void WriteReport(const Results& results, const std::filesystem::path& report_dir,
                 const ReportOptions& options = {});

}  // namespace aisle
