#pragma once

#include <cstdint>

namespace aisle {

/// Of the compiled code that makes frames and keeps them: all of the simulator, and what the
/// harness does with its pictures. The SLAM, the scores and the report are no part of it, so that
/// frames outlive every change of those. Taken by the build from its object files.
std::uint64_t RendererHash();

}  // namespace aisle
