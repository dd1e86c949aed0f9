#pragma once

#include <filesystem>

#include "harness/record/results.h"

namespace aisle {

/// The file beside the nights of a suite that remembers their medians.
std::filesystem::path HistoryPath(const std::filesystem::path& out);

struct PublishOptions {
  bool json = false;     ///< results.json on stdout instead of the table
  bool remember = true;  ///< file the medians with those of other nights
  int failure = 0;       ///< exit code of what failed on our side, if anything did
};

/// Writes the report, tells the user and returns the exit code. A night that cannot be remembered
/// is reported all the same; it ends as our own failure where nothing else failed.
int Publish(const Results& results, const std::filesystem::path& out,
            const PublishOptions& options = {});

}  // namespace aisle
