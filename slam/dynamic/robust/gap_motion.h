#pragma once

#include <array>
#include <optional>
#include <vector>

#include "slam/dynamic/robust/ego_motion.h"
#include "slam/dynamic/robust/gap_flow.h"
#include "slam/dynamic/robust/step.h"

namespace aisle::slam::dynamic {

/// Where the rig is expected now, since the newest frame kept: as it has been measured; as the
/// caller expects it, who knows the map; else as it moved before, since no vehicle jerks. Nothing
/// in the first frame.
std::optional<MotionPrior> PriorFor(const RobustState& before, std::int64_t stamp_ns,
                                    const KnownMotion& known, const EgoMotionOptions& options);

/// The rig's motion over the gaps.
struct GapMotions {
  std::vector<EgoMotion> motions;              ///< of the first flows, up to the first not found
  std::array<MeasurementNoise, kSlots> noise;  ///< with what these have taught
};

/// Finds the rig's motion over every gap; the longer ones start from what the frames between have
/// said. `memory` has been carried to the current frame.
GapMotions FindGapMotions(const Step& step, const std::vector<GapFlow>& flows,
                          const LabelMemory& memory, const std::optional<MotionPrior>& prior);

/// By which share a value measured over a gap moves the running one, so that all gaps learn at one
/// pace: each of the longer gaps is measured in its turn.
double LearningRate(std::size_t slot, const ToleranceOptions& options);

/// A running value once another one has been measured, which counts for the share `rate`.
template <typename Value>
Value RunningMean(const Value& known, const Value& measured, double rate) {
  return known + rate * (measured - known);
}

}  // namespace aisle::slam::dynamic
