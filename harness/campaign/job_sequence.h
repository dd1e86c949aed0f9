#pragma once

#include <memory>

#include "harness/campaign/job.h"
#include "harness/contract/sequence.h"
#include "harness/plugs/simulated_sequence.h"

namespace aisle {

/// How a job's scene is opened.
SimulatedSequenceOptions SimulationOf(const Job& job);

/// The frames of a job: its scene's, from the store where it keeps one, or its recording's. What
/// takes long is told on stdout as "@stage". `content_hash` may be null.
std::unique_ptr<Sequence> OpenSequence(const Job& job, std::uint64_t* content_hash = nullptr);

}  // namespace aisle
