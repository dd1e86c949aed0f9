#pragma once

#include <string>

#include "harness/score/associate.h"

namespace aisle {

enum class AlignmentMethod {
  kNone,
  kOrigin,  ///< the first pair's poses are laid on each other, orientation included
  kPosYaw,  ///< least squares over positions, of what an inertial system cannot observe: position
            ///< and a turn about the vertical z of both frames
  kSe3,     ///< least squares over positions, rigid (Umeyama 1991 without scale)
  kSim3,    ///< the same with scale; flatters a stereo system, never our default
};

/// "none", "origin", "posyaw", "se3", "sim3"; the inverse throws std::invalid_argument naming the
/// choices.
std::string Name(AlignmentMethod method);
AlignmentMethod AlignmentFromName(const std::string& name);

/// Of how many pairs an alignment leaves an error: with fewer it makes each 0 whatever the estimate
/// holds.
std::size_t FewestPairs(AlignmentMethod method);

struct AlignmentOptions {
  AlignmentMethod method = AlignmentMethod::kSe3;
  std::size_t first_n = 0;  ///< use the first n pairs only; 0: all
};

/// Lays an estimate onto truth: position p becomes scale·R·p + t, orientation R·R_estimate.
struct Alignment {
  Eigen::Isometry3d T_truth_estimate = Eigen::Isometry3d::Identity();
  double scale = 1;
  /// False where positions leave the rotation free (all on one line, or fewer than three): the
  /// positional error is still least, rotations must not be read.
  bool rotation_determined = true;
  /// False below FewestPairs: no error says anything.
  bool leaves_errors = true;
};

/// Umeyama, "Least-squares estimation of transformation parameters between two point patterns",
/// PAMI 1991, equations (38)-(43). Throws std::invalid_argument without pairs.
Alignment Align(const Trajectory& truth, const Trajectory& estimate,
                const std::vector<PosePair>& pairs, const AlignmentOptions& options = {});

Eigen::Isometry3d Apply(const Alignment& alignment, const Eigen::Isometry3d& T_world_rig);

}  // namespace aisle
