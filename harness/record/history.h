#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/record/results.h"

namespace aisle {

/// One score of one cell on one night: the median over seeds.
struct TrendPoint {
  std::string started, commit;
  std::string scene, twin, system, score;
  std::optional<double> median;
};

/// What would keep a night from being filed there (a damaged file, a folder that cannot be
/// written), with the remedy; empty: nothing. Makes no file.
std::string HistoryTrouble(const std::filesystem::path& database);

/// Files tonight's medians in an SQLite file (made where it is missing). The same evening filed
/// twice is one evening. Throws MachineError.
void AppendToHistory(const std::filesystem::path& database, const Results& results);

/// All nights of a suite in the order of time; empty where there is no file.
std::vector<TrendPoint> ReadHistory(const std::filesystem::path& database,
                                    const std::string& suite);

}  // namespace aisle
