#pragma once

#include "harness/contract/external.h"

namespace aisle {

/// What `dataset` and `trajectory` of a foreign system say that is shown frames over a stream and
/// answers at once (`contract: stream`): nothing is exported for it, and it can steer.
inline constexpr const char* kStreamFormat = "stream";

inline bool IsStream(const ExternalSystem& system) { return system.dataset == kStreamFormat; }

}  // namespace aisle
