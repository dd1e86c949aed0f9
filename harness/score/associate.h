#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/contract/estimate.h"

namespace aisle {

/// Whose rule says which estimate belongs to which truth. Each changes the numbers: report it.
enum class AssociationRule {
  /// Ours: smallest |dt| first, each pose used once, |dt| at most half a frame (half the smaller of
  /// the two median intervals) or, where one file is so dense that this is less, evo's 0.01 s, as
  /// far as it is no more than half of the larger interval; unless given. Equal |dt|: the earlier
  /// truth, then the earlier estimate. What would cross a closer pair stays alone: where a stamp of
  /// each is missing, the poses that are left over do not belong together.
  kNearest,
  /// evo: each stamp of the shorter trajectory (the estimate's on equal length) takes the nearest
  /// of the other, |dt| <= 0.01 s. Not one-to-one.
  kEvo,
  /// TUM scripts: closest first, one to one, |dt| < 0.02 s, strictly; pairs may cross.
  kTum,
  /// KITTI: no stamps, the i-th belongs to the i-th.
  kIndex,
};

struct AssociationOptions {
  AssociationRule rule = AssociationRule::kNearest;
  std::optional<std::int64_t> max_difference_ns = {};  ///< the rule's own where absent
};

/// Indices of poses that belong together. Rising in both with kNearest and kIndex; with kEvo one
/// side may repeat; with kTum rising in truth alone.
struct PosePair {
  std::size_t truth = 0;
  std::size_t estimate = 0;
  bool operator==(const PosePair&) const = default;
};

/// Both trajectories must have rising stamps. With kIndex unequal lengths throw
/// std::invalid_argument.
std::vector<PosePair> Associate(const Trajectory& truth, const Trajectory& estimate,
                                const AssociationOptions& options = {});

/// The bound that the rule puts on |dt| for these trajectories, in nanoseconds.
std::int64_t MaxDifferenceNs(const Trajectory& truth, const Trajectory& estimate,
                             const AssociationOptions& options);

/// Median step between stamps, in nanoseconds; 0 for fewer than two poses.
std::int64_t MedianIntervalNs(const Trajectory& trajectory);

/// The rule in words, with its bound, for reports: "nearest, one to one, |dt| <= 25 ms".
std::string Describe(AssociationRule rule, std::int64_t max_difference_ns);

}  // namespace aisle
