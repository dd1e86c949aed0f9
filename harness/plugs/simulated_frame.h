#pragma once

#include <vector>

#include "harness/contract/sequence.h"
#include "simulator/simulator.h"

namespace aisle {

/// The simulator's nouns as the harness has them.
StereoCalibration CalibrationOf(const sim::RigInfo& rig);
SequenceFrame FrameOf(std::int64_t id, sim::RenderedFrame frame,
                      const std::vector<sim::InstanceInfo>& instances);

}  // namespace aisle
