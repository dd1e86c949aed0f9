#pragma once

#include <string>
#include <vector>

#include "harness/contract/estimate.h"

namespace aisle {

/// Files of poses as a command line names them: TUM's, KITTI's, EuRoC's, or topics of bags.
struct PoseFiles {
  std::string truth;
  std::vector<std::string> estimates;
  std::string format;    ///< of all that are no bags; empty: told by content
  std::string times;     ///< of the KITTI files among them; empty: none given
  bool by_stamp = true;  ///< poses are told apart by their stamps, not by their places
};

struct PosesRead {
  Trajectory truth;
  std::vector<Trajectory> estimates;  ///< in the order of the files
};

/// Reads them all. KITTI's files have no stamps: held against one that has some they take those of
/// `times`, or of the times.txt that the benchmark's layout has beside them, which is said on
/// stderr, as is what a bag's reader has to note. Two by index need none.
/// Throws InputError where times are needed and there are none, or given and not needed.
PosesRead ReadPoseFiles(const PoseFiles& files);

}  // namespace aisle
