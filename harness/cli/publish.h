#pragma once

#include <filesystem>

#include "harness/record/results.h"

namespace aisle {

struct PublishOptions {
  bool json = false;     ///< results.json on stdout instead of the table
  bool remember = true;  ///< file the medians with those of other nights
  int failure = 0;       ///< exit code of what failed on our side, if anything did
};

/// Writes the report, tells the user and returns the exit code.
int Publish(const Results& results, const std::filesystem::path& out,
            const PublishOptions& options = {});

}  // namespace aisle
