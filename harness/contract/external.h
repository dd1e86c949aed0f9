#pragma once

#include <string>

namespace aisle {

/// Any other SLAM: a command that reads a dataset from disk and leaves a trajectory.
struct ExternalSystem {
  std::string name;
  /// Given to the shell after {dataset}, {calibration}, {output} and {seed} have been filled in.
  std::string command;
  std::string dataset = "euroc";   ///< euroc or kitti: what is exported for it
  std::string trajectory = "tum";  ///< tum, kitti or euroc: what it writes to {output}
  double timeout_s = 3600;
};

}  // namespace aisle
