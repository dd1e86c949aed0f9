#pragma once

#include <vector>

#include "harness/record/frames_csv.h"

namespace aisle {

/// A frame in which a system was far off.
struct WorstFrame {
  std::int64_t id = 0;
  double error_m = 0;
};

/// The `count` frames with the largest error of the live track, each at least `apart_s` from the
/// others; the largest first, of equal ones the earlier.
std::vector<WorstFrame> FindWorstFrames(const std::vector<FrameRow>& rows, std::size_t count,
                                        double apart_s);

}  // namespace aisle
