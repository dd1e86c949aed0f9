#pragma once

#include <vector>

#include "harness/score/pose_error.h"

namespace aisle {

/// The KITTI odometry score. Lengths for a warehouse are shorter than the benchmark's.
struct SegmentOptions {
  std::vector<double> lengths_m = {100, 200, 300, 400, 500, 600, 700, 800};
  std::size_t first_frame_step = 10;  ///< a segment starts at every n-th pose
};
/// 5, 10, …, 40 m: the lengths TartanAir uses, every fifth.
SegmentOptions ShortSegments();

struct SegmentError {
  std::size_t first = 0, last = 0;  ///< indices into the pairs
  double length_m = 0;              ///< nominal
  double translation_percent = 0;   ///< ‖E_t‖ / nominal length
  double rotation_deg_per_100m = 0;
};

/// The last pose of a segment is the first whose path along the truth is longer than the start's
/// plus the length; starts without one are skipped. E as in RelativeErrors.
std::vector<SegmentError> SegmentErrors(const Trajectory& truth, const Trajectory& estimate,
                                        const std::vector<PosePair>& pairs,
                                        const SegmentOptions& options = {});

struct SegmentScore {
  double translation_percent = 0;
  double rotation_deg_per_100m = 0;
  std::size_t segments = 0;
};
/// KITTI's mean: all segments pooled.
SegmentScore PooledMean(const std::vector<SegmentError>& errors);
/// TartanAir's mean: the mean of the means of each length.
SegmentScore MeanOfLengthMeans(const std::vector<SegmentError>& errors);

}  // namespace aisle
