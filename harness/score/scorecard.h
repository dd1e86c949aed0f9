#pragma once

#include <string>
#include <vector>

#include "harness/contract/run.h"
#include "harness/score/pose_error.h"
#include "harness/score/relative_error.h"

namespace aisle {

struct ScoreOptions {
  AssociationOptions association;
  AlignmentOptions alignment;
  RelativeOptions relative;  ///< of the rpe_* scores
};

/// A trajectory held against truth: all scores, and the errors behind them.
struct TrajectoryScore {
  Scorecard scores;
  std::vector<PosePair> pairs;
  Alignment alignment;
  std::vector<PoseError> errors;   ///< one per pair; none where alignment leaves none
  std::vector<std::string> notes;  ///< what a reader must know: a mismatch of conventions, …
  /// Brings the estimate's stamps to the truth's where they seem of another unit.
  std::optional<double> stamp_factor = {};
  std::string association;  ///< the rule in words
};

/// ATE (aligned as asked), RPE, KITTI segments long and short. Scores that cannot be had say why.
TrajectoryScore ScoreTrajectory(const Trajectory& truth, const Trajectory& estimate,
                                const ScoreOptions& options = {});

/// A run held against truth, once: all that its record, its frames and its archives say of it.
struct RunScore {
  /// The final track's, the live track's ATE, coverage, errors over all frames with lost ones
  /// counted as failures, masks, features, stage times.
  Scorecard scores;
  TrajectoryScore live, final;  ///< of the two tracks
};
RunScore ScoreRun(const RunResult& run, const ScoreOptions& options = {});

/// The mask scores of a run alone: object_*, mask_*, mover_*,
/// static_features_lost.
Scorecard ScoreMasks(const RunResult& run);

/// Says in words when positions agree and rotations are off by one constant turn: a file in the
/// body frame held against one in the camera frame, say. Empty where nothing is suspicious.
std::string FrameMismatch(const Trajectory& truth, const Trajectory& estimate,
                          const std::vector<PoseError>& errors, const Alignment& alignment);

/// A score with its value, and one without.
Score Present(double value, const std::string& unit, std::size_t n,
              const std::string& alignment = "");
Score Absent(const std::string& unit, const std::string& why);

/// part / whole over `whole` samples; absent for the reason `nothing` where there are none.
Score RatioScore(double part, double whole, const std::string& nothing);

/// "value m (n = 12, se3)" or "- (why not)".
std::string ToText(const Score& score);

}  // namespace aisle
