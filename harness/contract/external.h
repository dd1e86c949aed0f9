#pragma once

#include <string>

namespace aisle {

/// Any other SLAM: a command that reads a dataset from disk and leaves a trajectory.
struct ExternalSystem {
  /// Given to the shell after {dataset}, {calibration}, {output} and {seed} have been filled in.
  std::string command;
  std::string dataset = "euroc";   ///< euroc or kitti: what is exported for it
  std::string trajectory = "tum";  ///< tum, kitti or euroc: what it writes to {output}
  /// VSLAM-LAB's arguments are appended to the command and its trajectory file is read back; both
  /// fields above are then fixed. It holds key frames alone: coverage is not asked for.
  bool vslam_lab = false;
  double timeout_s = 3600;

  bool operator==(const ExternalSystem&) const = default;
};

}  // namespace aisle
