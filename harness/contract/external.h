#pragma once

#include <string>
#include <vector>

namespace aisle {

/// How a system that was wrapped for VSLAM-LAB takes its arguments.
enum class VslamLabStyle {
  kNone,    ///< it was not
  kWords,   ///< key:value, as the wrappers in C++ do
  kPython,  ///< --key value
};

/// Any other SLAM: a command that reads a dataset from disk and leaves a trajectory.
struct ExternalSystem {
  /// Given to the shell after {dataset}, {calibration}, {output}, {seed} and {source} have been
  /// filled in.
  std::string command;
  std::string dataset = "euroc";   ///< euroc or kitti: what is exported for it
  std::string trajectory = "tum";  ///< tum, kitti or euroc: what it writes to {output}
  /// Where it is one of these, VSLAM-LAB's arguments are appended to the command and its trajectory
  /// file is read back; both fields above are then fixed. It holds key frames alone: coverage is
  /// not asked for.
  VslamLabStyle vslam_lab = VslamLabStyle::kNone;
  double timeout_s = 3600;
  /// A command whose first line of output says which version of the system ran; empty: none.
  std::string version = {};
  /// Its sources, for `bisect`: a git repository, which {source} of the command stands for, and the
  /// command that builds a checkout of it, run there.
  std::string repository = {}, build = {};
  /// Times each input is driven, for a system that scatters on one and the same.
  int repeats = 1;
  /// Folders where it may write, beside its own of the run.
  std::vector<std::string> may_write = {};
  /// Variables of the environment that it sees, beside the usual ones. Their values are among what
  /// decides what it does.
  std::vector<std::string> environment = {};
  /// Files and folders that decide what it does, beside those its command names: a finished run is
  /// kept by --resume only while they are the same.
  std::vector<std::string> depends_on = {};

  bool operator==(const ExternalSystem&) const = default;
};

}  // namespace aisle
