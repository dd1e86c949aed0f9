#include "slam/dynamic/robust/gap_motion.h"

#include <algorithm>

#include "slam/common/parallel.h"
#include "slam/common/seconds.h"
#include "slam/dynamic/robust/residual_flow.h"

namespace aisle::slam::dynamic {
namespace {

using Eigen::Isometry3d;

const MeasurementNoise kLeastNoise(0.1, 0.1, 0.2), kMostNoise(1.0, 1.0, 2.0);  // full pixels

using GapMatches = std::vector<std::vector<StereoMatch>>;

GapMatches MatchOverGaps(const Step& step, const std::vector<GapFlow>& flows,
                         const LabelMemory& memory) {
  GapMatches matches(flows.size());
  ParallelFor(std::size_t{0}, flows.size(), [&](std::size_t k) {
    matches[k] =
        MatchesAlong(step.view.held, flows[k].flow, flows[k].expected.place, step.view.frame,
                     FrameAgo(step.before, flows[k].gap), memory, step.options.ego.trust_in_region);
  });
  return matches;
}

std::vector<EgoMotion> MotionsOf(const Step& step, const GapMatches& matches,
                                 const std::vector<GapFlow>& flows,
                                 const std::optional<MotionPrior>& prior) {
  const RobustState& before = step.before;
  std::vector<EgoMotion> motions(flows.size());
  if (flows.empty()) return motions;
  motions[0] =
      EstimateEgoMotion(matches[0], step.camera, prior, before.noise.match[0], step.options.ego);
  ParallelFor(std::size_t{1}, flows.size(), [&](std::size_t k) {
    const Isometry3d expected = MotionOver(flows[k].gap, before, motions[0].T_now_before);
    // The frames between have left little to find.
    motions[k] =
        RefineEgoMotion(matches[k], step.camera, expected, before.noise.match[flows[k].slot]);
  });
  const auto lost = std::find_if(motions.begin(), motions.end(),
                                 [](const EgoMotion& motion) { return !motion.found; });
  motions.erase(lost, motions.end());
  return motions;
}

/// The running noise of one gap after what its matches say of it.
MeasurementNoise MatchNoiseAfter(const MeasurementNoise& known,
                                 const std::vector<StereoMatch>& matches, const EgoMotion& motion,
                                 const StereoCamera& camera, double rate) {
  const auto measured = MeasureNoise(matches, camera, motion.T_now_before);
  if (!measured) return known;
  const MeasurementNoise bounded = measured->cwiseMax(kLeastNoise).cwiseMin(kMostNoise);
  return RunningMean(known, bounded, rate);
}

/// What wheels that go over something add to the rig's motion within a frame: heave, pitch and roll
/// of an upright camera. Where it goes and how it turns on the ground stays as it was, which is
/// what tells a jolt from somebody who fills the view. However long the step is, the rig is lifted
/// no higher than what it goes over.
Matrix6d OfAJolt(double step_s, const EgoMotionOptions& options) {
  constexpr double kMostHeave_m = 0.1;   // no sill is higher, nor what a wheel climbs
  constexpr double kMostTilt_rad = 0.2;  // one axle on that, the other half a metre behind
  const double heave = std::min(options.jolt_mps2 * step_s * step_s, kMostHeave_m),
               tilt = std::min(options.jolt_radps2 * step_s * step_s, kMostTilt_rad);
  Vector6d deviation;
  deviation << 0, heave, 0, tilt, 0, tilt;
  return deviation.cwiseAbs2().asDiagonal();
}

}  // namespace

double LearningRate(std::size_t slot, const ToleranceOptions& options) {
  const double kept = 1 - options.learning_rate;
  return slot == 0 ? options.learning_rate : 1 - std::pow(kept, kSlots - 1);
}

std::optional<MotionPrior> PriorFor(const RobustState& before, std::int64_t stamp_ns,
                                    const KnownMotion& known, const EgoMotionOptions& options) {
  // The caller knows of the last frame, which may have shown nothing.
  const auto since_kept = [&](const MeasuredMotion& last) {
    return before.unseen_way ? Compose(*before.unseen_way, last) : last;
  };
  if (known.measured) {
    const MeasuredMotion measured = since_kept(*known.measured);
    return MotionPrior{measured.T_now_before, measured.covariance, true};
  }
  const double step_s = SecondsBetween(before.stamp_ns, stamp_ns);
  const Matrix6d jolt = OfAJolt(step_s, options);
  if (known.expected) {
    const MeasuredMotion expected = since_kept(*known.expected);
    return MotionPrior{expected.T_now_before, expected.covariance, false, jolt};
  }
  if (!before.motion || before.step_s <= 0) return std::nullopt;
  const double steps = step_s / before.step_s;
  const Vector6d motion = Difference(Isometry3d::Identity(), before.motion->T_now_before);
  Vector6d deviation;
  deviation << Eigen::Vector3d::Constant(options.acceleration_mps2 * step_s * step_s),
      Eigen::Vector3d::Constant(options.angular_acceleration_radps2 * step_s * step_s);
  const Matrix6d jerk = deviation.cwiseAbs2().asDiagonal();
  return MotionPrior{Retract(Isometry3d::Identity(), motion * steps),
                     steps * steps * before.motion->covariance + jerk, false, jolt};
}

GapMotions FindGapMotions(const Step& step, const std::vector<GapFlow>& flows,
                          const LabelMemory& memory, const std::optional<MotionPrior>& prior) {
  const GapMatches matches = MatchOverGaps(step, flows, memory);
  GapMotions found{MotionsOf(step, matches, flows, prior), step.before.noise.match};
  ParallelFor(std::size_t{0}, found.motions.size(), [&](std::size_t k) {
    const std::size_t slot = flows[k].slot;
    found.noise[slot] = MatchNoiseAfter(step.before.noise.match[slot], matches[k], found.motions[k],
                                        step.camera, LearningRate(slot, step.options.tolerance));
  });
  return found;
}

}  // namespace aisle::slam::dynamic
