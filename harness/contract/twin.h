#pragma once

namespace aisle::twin {

/// Names of the twins of a scene that scores and pages compare with one another, as results and
/// command lines write them; the simulator has more (TwinNames in
/// harness/plugs/simulated_sequence.h).
inline constexpr const char* kLive = "live";      ///< people and vehicles move
inline constexpr const char* kEmpty = "empty";    ///< none of them is there
inline constexpr const char* kFrozen = "frozen";  ///< they stand still

}  // namespace aisle::twin
