#include "harness/score/segments.h"

#include <map>
#include <numbers>

namespace aisle {
namespace {

/// KITTI's own formula, as its printed digits come from it.
double AngleFromTraceRad(const Eigen::Matrix3d& rotation) {
  return std::acos(std::clamp((rotation.trace() - 1) / 2, -1.0, 1.0));
}

/// The general inverse, as the benchmark has it: its files' rotations are orthonormal to seven
/// digits only, and the transpose would move the fourth digit of the rotation score.
Eigen::Affine3d Inverse(const Eigen::Isometry3d& pose) {
  return Eigen::Affine3d(pose.matrix()).inverse();
}

std::vector<double> PathAlongTruthM(const Trajectory& truth, const std::vector<PosePair>& pairs) {
  Trajectory matched;
  matched.reserve(pairs.size());
  for (const PosePair& pair : pairs) matched.push_back(truth[pair.truth]);
  return PathLengthsM(matched);
}

SegmentError ErrorOf(const Trajectory& truth, const Trajectory& estimate, const PosePair& first,
                     const PosePair& last, double length_m) {
  const Eigen::Affine3d truth_step =
      Inverse(truth[first.truth].T_world_rig) * truth[last.truth].T_world_rig;
  const Eigen::Affine3d estimate_step =
      Inverse(estimate[first.estimate].T_world_rig) * estimate[last.estimate].T_world_rig;
  const Eigen::Affine3d error = estimate_step.inverse() * truth_step;
  return {.length_m = length_m,
          .translation_percent = 100 * error.translation().norm() / length_m,
          .rotation_deg_per_100m =
              100 * AngleFromTraceRad(error.linear()) * 180 / std::numbers::pi / length_m};
}

}  // namespace

SegmentOptions ShortSegments() { return {.lengths_m = {5, 10, 15, 20, 25, 30, 35, 40}}; }

std::vector<SegmentError> SegmentErrors(const Trajectory& truth, const Trajectory& estimate,
                                        const std::vector<PosePair>& pairs,
                                        const SegmentOptions& options) {
  const std::vector<double> path_m = PathAlongTruthM(truth, pairs);
  std::vector<SegmentError> errors;
  for (std::size_t first = 0; first < pairs.size(); first += options.first_frame_step) {
    for (const double length_m : options.lengths_m) {
      const auto end = std::upper_bound(path_m.begin(), path_m.end(), path_m[first] + length_m);
      if (end == path_m.end()) continue;
      const auto last = static_cast<std::size_t>(end - path_m.begin());
      errors.push_back(ErrorOf(truth, estimate, pairs[first], pairs[last], length_m));
      errors.back().first = first;
      errors.back().last = last;
    }
  }
  return errors;
}

SegmentScore PooledMean(const std::vector<SegmentError>& errors) {
  SegmentScore score{.segments = errors.size()};
  for (const SegmentError& error : errors) {
    score.translation_percent += error.translation_percent;
    score.rotation_deg_per_100m += error.rotation_deg_per_100m;
  }
  if (errors.empty()) return score;
  score.translation_percent /= static_cast<double>(errors.size());
  score.rotation_deg_per_100m /= static_cast<double>(errors.size());
  return score;
}

SegmentScore MeanOfLengthMeans(const std::vector<SegmentError>& errors) {
  std::map<double, std::vector<SegmentError>> by_length;
  for (const SegmentError& error : errors) by_length[error.length_m].push_back(error);
  SegmentScore score{.segments = errors.size()};
  for (const auto& [length_m, of_length] : by_length) {
    const SegmentScore mean = PooledMean(of_length);
    score.translation_percent += mean.translation_percent;
    score.rotation_deg_per_100m += mean.rotation_deg_per_100m;
  }
  if (by_length.empty()) return score;
  score.translation_percent /= static_cast<double>(by_length.size());
  score.rotation_deg_per_100m /= static_cast<double>(by_length.size());
  return score;
}

}  // namespace aisle
