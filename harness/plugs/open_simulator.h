#pragma once

#include "harness/plugs/simulated_sequence.h"
#include "simulator/simulator.h"

namespace aisle {

/// The simulator behind a simulated sequence. Throws InputError with the simulator's own message
/// (file:line:column) for a bad scene.
sim::Simulator OpenSimulator(const SimulatedSequenceOptions& options);

/// Throws InputError for a distorted lens where estimators are to see its pictures.
void RefuseLens(const sim::Simulator& simulator, const SimulatedSequenceOptions& options);

}  // namespace aisle
