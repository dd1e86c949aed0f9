#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/record/results.h"

namespace aisle {

/// One score of one cell on one night: the median over the seeds that have it, and where the middle
/// half of them lies.
struct TrendPoint {
  std::string started, commit;
  std::string scene, twin, system, score;
  std::optional<double> median;
  std::optional<double> low = {}, high = {};  ///< quartiles
  std::size_t seeds = 0;                      ///< each counts once, however often it ran
  std::size_t failed = 0;  ///< of them, those a run of which crashed, hung or left nonsense
  std::optional<double> limit = {};  ///< what the night was held against
  std::string version = {};          ///< of a foreign system, as it said
  std::string folder = {};  ///< of the night's report, from the file's folder on; empty: not known
};

/// What would keep a night from being filed there (a damaged file, one of no bytes among them, a
/// folder that cannot be written), with the remedy; empty: nothing. Makes no file.
std::string HistoryTrouble(const std::filesystem::path& database);

/// Files tonight's medians in an SQLite file (made where it is missing, brought up to date where an
/// earlier version made it). `report` is the night's folder. The same evening filed twice is one
/// evening. Throws MachineError, with the remedy.
void AppendToHistory(const std::filesystem::path& database, const Results& results,
                     const std::filesystem::path& report = {});

/// Whose place these results of the folder `report` would take there, in a sentence: that of
/// another folder under the same suite and start, be it the same night, moved or merged anew, or
/// one that began in the same instant. Empty: nobody's, or it cannot be read.
std::string NightReplaced(const std::filesystem::path& database, const Results& results,
                          const std::filesystem::path& report);

/// All nights of a suite in the order of time; empty where there is no file. Throws MachineError
/// where it is damaged, with the remedy.
std::vector<TrendPoint> ReadHistory(const std::filesystem::path& database,
                                    const std::string& suite);

}  // namespace aisle
