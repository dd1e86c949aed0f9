#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "harness/contract/drive_log.h"
#include "harness/record/record.h"

namespace aisle {

inline constexpr const char* kDriveName = "drive.json";

/// A closed drive as it is kept in the run's folder: both tracks at 20 samples a second, contacts,
/// route. Lengths in metres, angles in radians, times in seconds.
std::string ToJson(const DriveLog& log);
/// Throws InputError when the text is no drive of a known schema.
DriveLog DriveLogFromJson(const std::string& text, const std::string& file);

/// Writes it into the run's folder and names it in the record.
void WriteDrive(const DriveLog& log, const std::filesystem::path& report_dir, RunRecord* record);

/// The drive of a run, where it was a closed one and its file is whole.
std::optional<DriveLog> ReadDrive(const RunRecord& run, const std::filesystem::path& report_dir);

}  // namespace aisle
