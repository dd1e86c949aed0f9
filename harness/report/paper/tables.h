#pragma once

#include <string>
#include <vector>

#include "harness/record/group.h"

namespace aisle {

/// A table of numbers that can be written for a page, a wiki and a paper alike.
struct NumberTable {
  std::string title;
  std::string caption;                ///< unit, alignment, what a row is
  std::string group_head = "system";  ///< what `groups` are
  std::vector<std::string> groups;    ///< each spans all `columns`
  std::vector<std::string> columns;
  std::string unit;  ///< of all columns; empty where they name their own
  struct Row {
    std::string name;
    std::string scene;               ///< that it is of, or the paper's other data
    std::vector<std::string> cells;  ///< groups × columns; "-" where there is no number
    bool printed = false;            ///< by the paper, not measured here
    bool spread = false;             ///< how the seeds of the row above differ
    std::size_t seeds = 1;
    std::vector<std::string> intervals;  ///< one a cell (IntervalText); none of a single seed
  };
  std::vector<Row> rows;
};

/// The tables of the paper with our numbers, and what it printed beneath those of the scenes that
/// follow it: moving objects (its Table 1) and their detection (2), relative
/// drift and absolute error (3), absolute error (4), relative error (5), time of the front end (6),
/// largest error (Fig. 11, of its scenes alone); and what movers cost, where there are empty twins.
/// Medians over seeds and, where there are several, how they differ (SpreadText); live twins alone.
/// Tables without a number are left out. Last, what the base and what the rejection contribute
/// (BaseTable).
std::vector<NumberTable> PaperTables(const std::vector<SceneRuns>& scenes);

std::string ToHtml(const std::vector<NumberTable>& tables);
/// A row for each scene and group, and under it what the paper printed of them; intervals stand
/// behind their medians. Rows of spread are left out: least and most are on the page alone.
std::string ToMarkdown(const std::vector<NumberTable>& tables);
/// Needs the package booktabs.
std::string ToLatex(const std::vector<NumberTable>& tables);

}  // namespace aisle
