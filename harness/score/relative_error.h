#pragma once

#include <string>
#include <vector>

#include "harness/score/pose_error.h"

namespace aisle {

enum class DeltaUnit { kFrames, kMetres, kSeconds };

/// Which pairs of poses a relative error compares.
struct RelativeOptions {
  double delta = 1;
  DeltaUnit unit = DeltaUnit::kFrames;
  /// Every start instead of end-to-start neighbours.
  bool all_pairs = false;
  /// Metres are measured along the truth; evo measures them along the estimate unless told not to.
  bool along_estimate = false;
  /// How far off delta a pair may be with all_pairs in metres, as a fraction of delta (evo: 0.1).
  double tolerance = 0.1;
};

/// Start and end as indices into the list of associated pairs.
struct Span {
  std::size_t begin = 0;
  std::size_t end = 0;
  bool operator==(const Span&) const = default;
};

/// - frames: (i, i+δ); consecutive: i = 0, δ, 2δ, …
/// - metres, consecutive: steps are added up and cut where the sum reaches δ; spans join the cuts,
///   so the poses before the first cut and the tail take no part (evo's rule). All pairs: for each
///   start the later pose whose path length is nearest δ (the first of equals), kept within the
///   tolerance.
/// - seconds: the later pose whose stamp is nearest to stamp + δ, kept if off by at most half the
///   median interval; consecutive: the next span starts where the last one ended.
/// Seconds and metres are the truth's (metres the estimate's with along_estimate).
/// Throws std::invalid_argument for a delta that is not positive, or not whole for frames.
std::vector<Span> SelectSpans(const Trajectory& truth, const Trajectory& estimate,
                              const std::vector<PosePair>& pairs, const RelativeOptions& options);

struct RelativeError {
  Span span;
  double translation_m = 0;  ///< ‖translation of E‖
  double rotation_deg = 0;   ///< angle of the rotation of E
};

/// E = (Q_i⁻¹ Q_j)⁻¹ (P_i⁻¹ P_j), Q truth, P estimate (Sturm et al., IROS 2012, equation 2).
/// Needs no alignment.
std::vector<RelativeError> RelativeErrors(const Trajectory& truth, const Trajectory& estimate,
                                          const std::vector<PosePair>& pairs,
                                          const std::vector<Span>& spans);

/// The pairs in words, for reports: "1 m, consecutive, along the truth".
std::string Describe(const RelativeOptions& options);

std::vector<double> Translations(const std::vector<RelativeError>& errors);
std::vector<double> Rotations(const std::vector<RelativeError>& errors);

}  // namespace aisle
