#pragma once

#include <filesystem>

#include "harness/record/results.h"
#include "harness/report/report.h"

namespace aisle {

/// The file beside the nights of a suite that remembers their medians.
std::filesystem::path HistoryPath(const std::filesystem::path& out);

/// What a report says besides the night's results: what systems are, and how many limits its
/// folder's plan sets.
ReportOptions AboutNight(const std::filesystem::path& out);

/// The same with the nights up to this one; without them where this one was not filed, or where
/// their file cannot be read, which `history_trouble` says then.
ReportOptions WithHistory(const Results& results, const std::filesystem::path& out);

/// Takes away what a report says of its runs, so that nobody takes the last night's word for the
/// one that begins. What comes of it is written anew.
void RemoveReport(const std::filesystem::path& out);

struct PublishOptions {
  bool json = false;                  ///< results.json on stdout instead of the table
  bool remember = true;               ///< file the medians with those of other nights
  std::filesystem::path allure = {};  ///< folder for Allure results; empty: none
  int failure = 0;                    ///< exit code of what failed on our side, if anything did
};

/// Writes the report, tells the user and returns the exit code. A night that cannot be remembered
/// is reported all the same; it ends as our own failure where nothing else failed.
int Publish(const Results& results, const std::filesystem::path& out,
            const PublishOptions& options = {});

}  // namespace aisle
