#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/contract/estimate.h"

namespace aisle {

/// TUM: "timestamp tx ty tz qx qy qz qw", '#' comments. Stamps are seconds, or nanoseconds where
/// one of the first hundred rows has 13 or more digits before its point, or where they are whole
/// and step by a million or more: ORB-SLAM3 writes what it makes of EuRoC so.
/// KITTI: 12 numbers a line, the first three rows of T_world_rig; no stamps. Some programs put the
/// frame's number before them.
/// EuRoC: csv "stamp in ns, p x y z, q w x y z[, v, biases]".
enum class TrajectoryFormat { kTum, kKitti, kEuroc };

/// "tum", "kitti", "euroc"; throws InputError naming the choices.
TrajectoryFormat TrajectoryFormatFromName(const std::string& name);
/// "TUM, qw last": what a reader needs to know of it.
std::string Describe(TrajectoryFormat format);

/// Judges by the titles of the columns in a comment above them, the number of columns and the
/// stamps. Absent where these do not tell: 8 columns without titles, the first whole numbers of
/// nanoseconds, are EuRoC's, with qw first, or TUM's, with qw last. Throws InputError if it is none
/// of the three, seconds under titles with qw first too.
std::optional<TrajectoryFormat> TellTrajectoryFormat(const std::filesystem::path& path);
/// The same; throws InputError with the cure where the file does not tell.
TrajectoryFormat GuessTrajectoryFormat(const std::filesystem::path& path);

/// The times of a KITTI file where the benchmark's layout has them: ROOT/sequences/NN/times.txt of
/// ROOT/poses/NN.txt. Empty where there are none.
std::filesystem::path KittiTimesBeside(const std::filesystem::path& poses);

/// In which order the rows of a file with stamps may stand.
enum class RowOrder {
  kRising,  ///< by stamp: another one is a mistake
  kAny,     ///< they are sorted; rows of one stamp stay in the order of the file
};

/// From one frame of a KITTI file to the next where nothing else is known: the benchmark's 10 Hz.
inline constexpr std::int64_t kKittiStepNs = 100'000'000;

/// Reads and checks: every number finite, quaternions of norm 1 ± 0.05 (then normalised), stamps
/// not falling (published files do repeat a stamp here and there). Stamps are parsed as decimals,
/// never through a double. KITTI poses are kept as written (their rotations are orthonormal to the
/// printed digits only) and stamped k × 0.1 s for row k, or for frame k where the rows say it,
/// unless `times` names a file with a time in seconds per line. Throws InputError with file:line.
Trajectory ReadTrajectory(const std::filesystem::path& path, TrajectoryFormat format,
                          const std::filesystem::path& times = {},
                          RowOrder order = RowOrder::kRising);

/// The text of a trajectory file. TUM stamps have 9 decimals; every number reads back bit for bit;
/// no trailing spaces. EuRoC gets all 17 columns, velocities by central differences, biases 0.
std::string FormatTrajectory(const Trajectory& trajectory, TrajectoryFormat format);
/// EuRoC's 17 columns with the velocities given, one per pose: m/s, world.
std::string FormatEurocTruth(const Trajectory& trajectory,
                             const std::vector<Eigen::Vector3d>& velocities_mps);

/// "1403715529.112143517", "1.4037155e+09" -> nanoseconds, exactly (rounded half up below 1 ns).
/// False if it is not a plain decimal number or out of range.
bool ParseSecondsToNs(std::string_view text, std::int64_t* stamp_ns);
/// 1403715529112143517 -> "1403715529.112143517".
std::string FormatSeconds(std::int64_t stamp_ns);

}  // namespace aisle
