#include "slam/dynamic/robust/past_evidence.h"

#include "slam/common/parallel.h"
#include "slam/common/seconds.h"
#include "slam/dynamic/robust/motion_evidence.h"

namespace aisle::slam::dynamic {
namespace {

constexpr double kLeastFlowNoise = 0.05, kMostFlowNoise = 0.5;  // half-size pixels

MotionEvidence CompareOver(const Step& step, const GapFlow& flow, const EgoMotion& motion,
                           const LabelMemory& memory) {
  const auto& [before, view, image, camera, half, tolerance, options] = step;
  const DenseFrame& then = FrameAgo(before, flow.gap);
  const Comparison comparison{.now = view.frame,
                              .then = then,
                              .flow = flow.flow,
                              .tolerance = tolerance,
                              .T_then_now = motion.T_now_before.inverse(),
                              .seconds = SecondsBetween(then.stamp_ns, view.frame.stamp_ns),
                              .flow_noise = before.noise.flow[flow.slot],
                              .disparities = options.disparity.max_disparity_px,
                              .sure = options.region.core_log_odds,
                              .regions = memory.regions.labels,
                              .memory = memory.log_odds,
                              .monocular = flow.slot == 0};
  return CompareMotion(comparison, view.texture, view.around, half, options.evidence);
}

/// The running noise of one gap's flow after what a comparison over it says.
double FlowNoiseAfter(double known, const std::optional<double>& measured, double rate) {
  if (!measured) return known;
  return RunningMean(known, std::clamp(*measured, kLeastFlowNoise, kMostFlowNoise), rate);
}

/// The same step where it says something, and nothing elsewhere.
LatestStep WhereKnown(LatestStep step, const cv::Mat1f& log_odds) {
  const cv::Mat unknown = log_odds == 0;
  step.variance = step.variance.clone();
  step.variance.setTo(1e6F, unknown);
  return step;
}

/// What a gap says in its turn, and where others have seen motion that is not refuted, what they
/// say if it is more.
GapEvidence Together(const GapEvidence& carried, const GapEvidence& own) {
  if (carried.log_odds.empty()) return own;
  GapEvidence both{own.log_odds.clone(), own.per_step.clone()};
  const cv::Mat other = (carried.log_odds > 0) & (carried.log_odds > own.log_odds);
  carried.log_odds.copyTo(both.log_odds, other);
  carried.per_step.copyTo(both.per_step, other);
  return both;
}

}  // namespace

PastEvidence WeighPast(const Step& step, const std::vector<GapFlow>& flows,
                       const std::vector<EgoMotion>& motions, const LabelMemory& memory) {
  const RobustState& before = step.before;
  const View& view = step.view;
  const RobustOptions& options = step.options;
  PastEvidence past{.gaps = {},
                    .log_odds = cv::Mat1f(view.frame.image.size(), 0.0F),
                    .ended = {},
                    .flow_noise = before.noise.flow};
  past.ended = past.log_odds.clone();
  if (motions.empty()) return past;

  std::vector<MotionEvidence> found(motions.size());
  ParallelFor(std::size_t{0}, motions.size(),
              [&](std::size_t k) { found[k] = CompareOver(step, flows[k], motions[k], memory); });
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const std::size_t slot = flows[k].slot;
    cv::Mat2f per_step;
    per_step = found[k].step.residual / flows[k].gap;
    past.gaps.push_back({found[k].log_odds, per_step});
    past.flow_noise[slot] = FlowNoiseAfter(before.noise.flow[slot], found[k].flow_noise,
                                           LearningRate(slot, options.tolerance));
  }

  const auto take_off = [&](const LatestStep& latest, int count, GapEvidence& said) {
    const EndedMotion less = TakeOffEndedMotion(latest, count, view.texture, said.per_step,
                                                said.log_odds, options.evidence);
    said.log_odds = less.log_odds;
    past.ended = cv::max(past.ended, less.taken);
  };
  past.longer = {memory.long_log_odds, memory.long_per_step};
  if (!past.longer.log_odds.empty()) take_off(found[0].step, flows[0].gap, past.longer);
  if (motions.size() > 1) {
    GapEvidence& own = past.gaps[1];
    take_off(found[0].step, flows[0].gap, own);
    // What swings may be where it was over a longer way, and has moved nevertheless.
    if (!past.longer.log_odds.empty() && flows[1].slot < before.long_slot) {
      take_off(WhereKnown(found[1].step, own.log_odds), flows[1].gap, past.longer);
    }
    past.longer = Together(past.longer, own);
  }
  past.log_odds = CombineGaps({past.gaps[0].log_odds, past.longer.log_odds}, options.field.moving,
                              options.evidence);
  return past;
}

}  // namespace aisle::slam::dynamic
