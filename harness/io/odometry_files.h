#pragma once

#include <filesystem>
#include <vector>

#include "harness/contract/estimate.h"
#include "harness/contract/sequence.h"
#include "harness/io/dataset.h"

namespace aisle {

/// Motions of the rig from frame to frame, one fewer than `frames`, joined to a track: its poses at
/// the frames, from the first one's coordinates on (identity). Throws std::invalid_argument for
/// another number of motions, InputError where the wheels were silent: a track has no gaps.
Trajectory JoinMotions(const std::vector<FrameRequest>& frames, const WheelMotions& motions);

/// Writes such a track beside the images of an exported dataset, which begins with its first pose:
/// EuRoC's as mav0/odom0/{sensor.yaml, data.csv} (stamp, position, quaternion with w first),
/// KITTI's as sequences/00/odometry.txt (rows as of its poses), TUM's as odometry.txt. Throws
/// MachineError where it cannot.
void WriteOdometry(const std::filesystem::path& folder, const Trajectory& track,
                   const ExportOptions& options);

/// Such a track as it is read again: of a base_link at the left camera, looking ahead. Nothing
/// where a dataset has none. `mav` is EuRoC's folder mav0, `sequence` KITTI's sequences/NN.
std::function<WheelTrack()> WheelsOfEuroc(const std::filesystem::path& mav,
                                          const Eigen::Isometry3d& T_body_left);
std::function<WheelTrack()> WheelsOfKitti(const std::filesystem::path& sequence);

}  // namespace aisle
