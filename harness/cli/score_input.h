#pragma once

#include <string>
#include <vector>

#include "harness/contract/estimate.h"

namespace aisle {

/// Files of poses as a command line names them: TUM's, KITTI's, EuRoC's, or topics of bags.
struct PoseFiles {
  std::string truth = {};
  std::vector<std::string> estimates = {};
  std::string format_truth = {};     ///< of one that is no bag; empty: told by content
  std::string format_estimate = {};  ///< the same of all estimates
  std::string times = {};            ///< of the KITTI files among them; empty: none given
  bool by_stamp = true;              ///< poses are told apart by their stamps, not by their places
};

struct PosesRead {
  Trajectory poses;
  std::string format;  ///< what it was read as, in words: "TUM, qw last"
  std::string note;    ///< why, where neither the file nor its user says; else empty
};
struct AllPosesRead {
  PosesRead truth;
  std::vector<PosesRead> estimates;  ///< in the order of the files
};

/// Reads them all. KITTI's files have no stamps: held against one that has some they take those of
/// `times`, or of the times.txt that the benchmark's layout has beside them, which is said on
/// stderr, as is what a bag's reader has to note. Two by index need none. An estimate of which
/// nothing tells whether qw is its first or last is read as it moves like the truth.
/// Throws InputError where times are needed and there are none, or given and not needed, and where
/// the truth does not tell the place of qw either.
AllPosesRead ReadPoseFiles(const PoseFiles& files);

}  // namespace aisle
