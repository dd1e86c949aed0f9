#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "harness/io/trajectory.h"

namespace aisle {

/// A file's name and what it holds, for those who look at it several times: a pipe can be read
/// once.
struct TextFile {
  std::filesystem::path name;
  std::string text;
};

/// Throws InputError as ReadFile does.
TextFile ReadTextFile(const std::filesystem::path& path);

/// What trajectory.h has of files, of their text.
std::optional<TrajectoryFormat> TellTrajectoryFormat(const TextFile& file);
Trajectory ReadTrajectory(const TextFile& file, TrajectoryFormat format,
                          const std::optional<TextFile>& times = {},
                          RowOrder order = RowOrder::kRising);

}  // namespace aisle
