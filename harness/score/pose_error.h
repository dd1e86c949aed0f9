#pragma once

#include <vector>

#include "harness/score/align.h"
#include "harness/score/statistics.h"

namespace aisle {

/// Angle of a rotation in degrees, [0, 180]. Exact near 0 and near 180 alike.
double RotationAngleDeg(const Eigen::Matrix3d& rotation);

/// Error of one associated pose after alignment.
struct PoseError {
  PosePair pair;
  double translation_m = 0;  ///< ‖p_estimate - p_truth‖
  double rotation_deg = 0;   ///< angle of R_estimateᵀ R_truth
};

/// Absolute trajectory errors (evo's APE), one per pair, in the pairs' order.
std::vector<PoseError> AbsoluteErrors(const Trajectory& truth, const Trajectory& estimate,
                                      const std::vector<PosePair>& pairs,
                                      const Alignment& alignment);

/// Length of the path through the poses, metres; entry i is the length up to pose i.
std::vector<double> PathLengthsM(const Trajectory& trajectory);

std::vector<double> Translations(const std::vector<PoseError>& errors);
std::vector<double> Rotations(const std::vector<PoseError>& errors);

}  // namespace aisle
