#include "harness/score/step_difference.h"

#include "harness/score/relative_error.h"

namespace aisle {
namespace {

/// Each span's motion as the rig saw it, in the place of a position.
Trajectory Steps(const Trajectory& trajectory, const std::vector<PosePair>& pairs,
                 std::size_t PosePair::*side, const std::vector<Span>& spans) {
  Trajectory steps;
  for (const Span& span : spans) {
    const Eigen::Isometry3d& T_world_from = trajectory[pairs[span.begin].*side].T_world_rig;
    const Eigen::Isometry3d& T_world_to = trajectory[pairs[span.end].*side].T_world_rig;
    StampedPose& step = steps.emplace_back();
    step.T_world_rig.translation() =
        T_world_from.linear().transpose() * (T_world_to.translation() - T_world_from.translation());
  }
  return steps;
}

}  // namespace

std::optional<double> StepDifferenceM(const Trajectory& truth, const Trajectory& estimate) {
  const std::vector<PosePair> pairs = Associate(truth, estimate);
  const std::vector<Span> spans = SelectSpans(
      truth, estimate, pairs, {.delta = 1, .unit = DeltaUnit::kSeconds, .all_pairs = true});
  constexpr std::size_t kFewest = 4;  // a similarity fits three
  if (spans.size() < kFewest) return std::nullopt;
  const Trajectory true_steps = Steps(truth, pairs, &PosePair::truth, spans);
  const Trajectory steps = Steps(estimate, pairs, &PosePair::estimate, spans);
  std::vector<PosePair> each(spans.size());
  for (std::size_t i = 0; i < each.size(); ++i) each[i] = {i, i};
  const Alignment alignment =
      Align(true_steps, steps, each, {.method = AlignmentMethod::kSim3, .first_n = 0});
  return Summarize(Translations(AbsoluteErrors(true_steps, steps, each, alignment))).rmse;
}

Reading ReadingLikeTruth(const Trajectory& truth, const Trajectory& first,
                         const Trajectory& second) {
  constexpr double kClearly = 3;
  const auto of_first = StepDifferenceM(truth, first), of_second = StepDifferenceM(truth, second);
  if (!of_first || !of_second) return Reading::kEither;
  if (*of_first * kClearly < *of_second) return Reading::kFirst;
  return *of_second * kClearly < *of_first ? Reading::kSecond : Reading::kEither;
}

}  // namespace aisle
