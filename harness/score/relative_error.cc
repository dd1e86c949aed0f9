#include "harness/score/relative_error.h"

#include <stdexcept>

#include "harness/common/seconds.h"

namespace aisle {
namespace {

Trajectory Select(const Trajectory& trajectory, const std::vector<PosePair>& pairs,
                  std::size_t PosePair::*side) {
  Trajectory selected;
  selected.reserve(pairs.size());
  for (const PosePair& pair : pairs) selected.push_back(trajectory[pair.*side]);
  return selected;
}

std::vector<Span> FrameSpans(std::size_t count, std::size_t delta, bool all_pairs) {
  std::vector<Span> spans;
  for (std::size_t i = 0; i + delta < count; i += all_pairs ? 1 : delta) {
    spans.push_back({i, i + delta});
  }
  return spans;
}

std::vector<Span> ConsecutiveMetreSpans(const Trajectory& poses, double delta_m) {
  std::vector<std::size_t> cuts;
  double since_cut = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    since_cut +=
        (poses[i].T_world_rig.translation() - poses[i - 1].T_world_rig.translation()).norm();
    if (since_cut < delta_m) continue;
    cuts.push_back(i);
    since_cut = 0;
  }
  std::vector<Span> spans;
  for (std::size_t k = 1; k < cuts.size(); ++k) spans.push_back({cuts[k - 1], cuts[k]});
  return spans;
}

/// Index in [from, positions.size()) whose value is nearest to the target, the first of equals.
/// Positions do not fall.
std::size_t NearestFrom(const std::vector<double>& positions, std::size_t from, double target) {
  const auto first = positions.begin() + static_cast<std::ptrdiff_t>(from);
  auto after = std::lower_bound(first, positions.end(), target);
  if (after == first) return from;
  if (after == positions.end() || target - *std::prev(after) <= *after - target) {
    after = std::lower_bound(first, positions.end(), *std::prev(after));
  }
  return static_cast<std::size_t>(after - positions.begin());
}

std::vector<Span> NearestSpans(const std::vector<double>& positions, double delta, double tolerance,
                               bool all_pairs) {
  std::vector<Span> spans;
  std::size_t i = 0;
  while (i + 1 < positions.size()) {
    const std::size_t j = NearestFrom(positions, i + 1, positions[i] + delta);
    const bool fits = std::abs(positions[j] - positions[i] - delta) <= tolerance;
    if (fits) spans.push_back({i, j});
    i = fits && !all_pairs ? j : i + 1;
  }
  return spans;
}

std::vector<double> SecondsOf(const Trajectory& poses) {
  std::vector<double> seconds;
  seconds.reserve(poses.size());
  // From the first stamp on: seconds since 1970 in a double would lose the nanoseconds.
  for (const StampedPose& pose : poses) {
    seconds.push_back(ToSeconds(pose.stamp_ns - poses.front().stamp_ns));
  }
  return seconds;
}

}  // namespace

std::vector<Span> SelectSpans(const Trajectory& truth, const Trajectory& estimate,
                              const std::vector<PosePair>& pairs, const RelativeOptions& options) {
  if (!(options.delta > 0)) {
    throw std::invalid_argument(fmt::format("delta = {}: must be positive", options.delta));
  }
  if (options.unit == DeltaUnit::kFrames) {
    if (options.delta != std::floor(options.delta)) {
      throw std::invalid_argument(fmt::format("delta = {}: frames are whole", options.delta));
    }
    if (options.delta >= static_cast<double>(pairs.size())) return {};
    return FrameSpans(pairs.size(), static_cast<std::size_t>(options.delta), options.all_pairs);
  }
  const bool on_estimate = options.along_estimate && options.unit == DeltaUnit::kMetres;
  const Trajectory poses = on_estimate ? Select(estimate, pairs, &PosePair::estimate)
                                       : Select(truth, pairs, &PosePair::truth);
  if (options.unit == DeltaUnit::kSeconds) {
    const double half_frame_s = static_cast<double>(MedianIntervalNs(poses)) * 0.5e-9;
    return NearestSpans(SecondsOf(poses), options.delta, half_frame_s, options.all_pairs);
  }
  if (!options.all_pairs) return ConsecutiveMetreSpans(poses, options.delta);
  return NearestSpans(PathLengthsM(poses), options.delta, options.tolerance * options.delta, true);
}

std::vector<RelativeError> RelativeErrors(const Trajectory& truth, const Trajectory& estimate,
                                          const std::vector<PosePair>& pairs,
                                          const std::vector<Span>& spans) {
  std::vector<RelativeError> errors;
  errors.reserve(spans.size());
  for (const Span& span : spans) {
    const PosePair &i = pairs[span.begin], &j = pairs[span.end];
    const Eigen::Isometry3d truth_step =
        truth[i.truth].T_world_rig.inverse() * truth[j.truth].T_world_rig;
    const Eigen::Isometry3d estimate_step =
        estimate[i.estimate].T_world_rig.inverse() * estimate[j.estimate].T_world_rig;
    const Eigen::Isometry3d error = truth_step.inverse() * estimate_step;
    errors.push_back({.span = span,
                      .translation_m = error.translation().norm(),
                      .rotation_deg = RotationAngleDeg(error.linear())});
  }
  return errors;
}

std::string Describe(const RelativeOptions& options) {
  const char* pairs = options.all_pairs ? "all pairs" : "consecutive";
  switch (options.unit) {
    case DeltaUnit::kFrames:
      return fmt::format("{:g} frame, {}", options.delta, pairs);
    case DeltaUnit::kSeconds:
      return fmt::format("{:g} s, {}", options.delta, pairs);
    case DeltaUnit::kMetres:
      break;
  }
  return fmt::format("{:g} m, {}, along the {}", options.delta, pairs,
                     options.along_estimate ? "estimate" : "truth");
}

std::vector<double> Translations(const std::vector<RelativeError>& errors) {
  std::vector<double> values;
  values.reserve(errors.size());
  for (const RelativeError& error : errors) values.push_back(error.translation_m);
  return values;
}

std::vector<double> Rotations(const std::vector<RelativeError>& errors) {
  std::vector<double> values;
  values.reserve(errors.size());
  for (const RelativeError& error : errors) values.push_back(error.rotation_deg);
  return values;
}

}  // namespace aisle
