#pragma once

#include <optional>

#include "harness/contract/estimate.h"

namespace aisle {

/// How differently two rigs saw their own motion over a second, R_iᵀ (p_j - p_i): root mean square
/// in metres of the truth, after the similarity between these steps that fits best, so that neither
/// worlds nor rigs nor scales need be the same. Absent with fewer than four such steps.
///
/// It tells whether the parts of a quaternion were read in their order. A cyclic shift of them is a
/// reflection of the sphere of quaternions: what should be R_i is read as A R_iᵀ B with constant A
/// and B, in which all turns from pose to pose have the angles that they should have. So no file
/// tells by itself; but the steps, seen from such rotations, are not those of the truth.
std::optional<double> StepDifferenceM(const Trajectory& truth, const Trajectory& estimate);

/// Which of two readings of one file moves as the truth does.
enum class Reading { kFirst, kSecond, kEither };

/// kEither where the smaller difference is not clearly smaller (a third) or there is none: a rig
/// that never turns moves alike in both.
Reading ReadingLikeTruth(const Trajectory& truth, const Trajectory& first,
                         const Trajectory& second);

}  // namespace aisle
