#pragma once

#include <filesystem>
#include <string>

#include "harness/record/group.h"

namespace aisle {

/// The paper's experiment beside ours, on one page: its tables with our medians, the least and the
/// most over the seeds, and what it printed; its Fig. 9 and 10 (error and rejected corners over the
/// frames of scene 1) and Fig. 11 (tracks of scenes 2 to 5), with what it says of them. Empty
/// unless one of its scenes has been driven live. Reads frames.csv of each system's first seed.
std::string PaperPage(const std::vector<SceneRuns>& scenes,
                      const std::filesystem::path& report_dir);

}  // namespace aisle
