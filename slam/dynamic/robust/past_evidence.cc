#include "slam/dynamic/robust/past_evidence.h"

#include "slam/dynamic/robust/motion_evidence.h"

namespace aisle::slam::dynamic {
namespace {

constexpr double kLeastFlowNoise = 0.05, kMostFlowNoise = 0.5;  // half-size pixels

MotionEvidence CompareOver(const GapFlow& flow, const EgoMotion& motion, const RobustState& before,
                           const View& view, const LabelMemory& memory, const StereoCamera& half,
                           const DisparityTolerance& tolerance, const RobustOptions& options) {
  const DenseFrame& then = FrameAgo(before, flow.gap);
  const Comparison comparison{view.frame,
                              then,
                              flow.flow,
                              tolerance,
                              motion.T_now_before.inverse(),
                              Seconds(then.stamp_ns, view.frame.stamp_ns),
                              before.noise.flow[flow.slot],
                              memory.regions.labels,
                              memory.log_odds,
                              options.region.core_log_odds,
                              options.disparity.max_disparity_px};
  return CompareMotion(comparison, view.texture, view.around, half, options.evidence);
}

double Learned(double known, const std::optional<double>& measured, double rate) {
  if (!measured) return known;
  return known + rate * (std::clamp(*measured, kLeastFlowNoise, kMostFlowNoise) - known);
}

}  // namespace

PastEvidence WeighPast(const RobustState& before, const View& view,
                       const std::vector<GapFlow>& flows, const std::vector<EgoMotion>& motions,
                       const LabelMemory& memory, const StereoCamera& half,
                       const DisparityTolerance& tolerance, const RobustOptions& options) {
  PastEvidence past{{}, cv::Mat1f(view.frame.image.size(), 0.0F), {}, before.noise.flow};
  past.ended = past.log_odds.clone();
  if (motions.empty()) return past;

  std::array<GapEvidence, kGaps.size()> said;  // by slot
  if (before.long_slot > 0) {
    said[before.long_slot] = {memory.long_log_odds, memory.long_per_step};
  }
  LatestStep latest;
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const std::size_t slot = flows[k].slot;
    const MotionEvidence found =
        CompareOver(flows[k], motions[k], before, view, memory, half, tolerance, options);
    said[slot].log_odds = found.log_odds;
    said[slot].per_step = found.step.residual / flows[k].gap;
    if (slot == 0) latest = found.step;
    past.flow_noise[slot] =
        Learned(before.noise.flow[slot], found.flow_noise, LearningRate(slot, options.tolerance));
  }

  std::vector<cv::Mat1f> log_odds = {said[0].log_odds};
  for (std::size_t slot = 1; slot < kGaps.size(); ++slot) {
    if (!said[slot].log_odds.empty()) {
      const EndedMotion less = TakeOffEndedMotion(latest, view.texture, said[slot].per_step,
                                                  said[slot].log_odds, options.evidence);
      said[slot].log_odds = less.log_odds;
      past.ended = cv::max(past.ended, less.taken);
    }
    log_odds.push_back(said[slot].log_odds);
  }
  for (std::size_t k = 0; k < motions.size(); ++k) past.gaps.push_back(said[flows[k].slot]);
  past.log_odds = CombineGaps(log_odds, options.field.moving, options.evidence);
  return past;
}

}  // namespace aisle::slam::dynamic
