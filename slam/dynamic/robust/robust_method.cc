#include "slam/dynamic/robust/robust_method.h"

#include <algorithm>
#include <cmath>

#include "slam/common/parallel.h"
#include "slam/common/seconds.h"
#include "slam/common/stopwatch.h"
#include "slam/dynamic/common/in_parallel.h"
#include "slam/dynamic/robust/gap_motion.h"
#include "slam/dynamic/robust/pixel_labels.h"
#include "slam/dynamic/robust/step.h"

namespace aisle::slam::dynamic {
namespace {

using Eigen::Isometry3d;

/// What was known of the pixels, where they are now; all is forgotten without a way back.
LabelMemory Carried(const Step& step, const std::vector<GapFlow>& flows) {
  const RobustState& before = step.before;
  if (flows.empty()) {
    return ForgottenMemory(step.view.frame.image.size(), before.memory.regions.next_id);
  }
  return CarryMemory(before.memory, flows[0].flow, flows[0].expected.disparity, step.view.frame,
                     before.frames.back(), step.tolerance);
}

/// What is known of the pixels after this frame: what was known, less what has ended, fades, and
/// what the past says now comes to it.
cv::Mat1f Accumulate(const cv::Mat1f& known, const PastEvidence& past,
                     const FieldOptions& options) {
  const auto memory = static_cast<float>(options.memory), limit = static_cast<float>(options.limit);
  cv::Mat1f log_odds(known.size());
  ParallelFor(0, known.rows, [&](int y) {
    const float *was = known[y], *off = past.ended[y], *says = past.log_odds[y];
    float* sum = log_odds[y];
    for (int x = 0; x < known.cols; ++x) {
      const float still = was[x] > 0 ? std::max(was[x] - off[x], 0.0F) : was[x];
      sum[x] = std::clamp(std::fma(memory, still, says[x]), -limit, limit);
    }
  });
  return log_odds;
}

/// What the longer gaps say in the next frame, where another one has its turn.
cv::Mat1f ToCarry(const GapEvidence& evidence, const RobustOptions& options) {
  if (evidence.log_odds.empty()) return {};
  cv::Mat1f carried;
  cv::max(evidence.log_odds, options.evidence.least, carried);
  cv::min(carried, options.evidence.most, carried);
  carried *= options.field.longer;
  return carried;
}

std::vector<DenseFrame> FramesWith(std::vector<DenseFrame> frames, DenseFrame now,
                                   const std::vector<EgoMotion>& motions) {
  if (motions.empty()) {
    frames.clear();  // the way back is lost: a new past begins
  } else {
    now.T_world_rig = Normalized(frames.back().T_world_rig * motions[0].T_now_before.inverse());
  }
  return WithFrame(std::move(frames), std::move(now));
}

/// All that one step has found.
struct Found {
  View view;
  std::vector<GapFlow> flows;
  GapMotions motions;
  Layout layout;
  PastEvidence past;
  cv::Mat1f log_odds;
  PixelLabels labels;
};

/// The state for the next step.
RobustState Remember(const RobustState& before, const Found& found, const RobustOptions& options) {
  const std::vector<EgoMotion>& motions = found.motions.motions;
  RobustState state = before;
  state.unseen_way.reset();
  state.stuck_at.reset();
  state.stamp_ns = found.view.frame.stamp_ns;
  state.frames = FramesWith(before.frames, found.view.frame, motions);
  if (!motions.empty()) {
    state.motion = motions[0];
    state.step_s = SecondsBetween(before.stamp_ns, state.stamp_ns);
  }
  state.noise = {found.motions.noise, found.past.flow_noise};
  state.memory = {found.log_odds, found.labels.regions};
  state.long_slot = motions.size() > 1 ? found.flows[motions.size() - 1].slot : 0;
  state.memory.long_log_odds = ToCarry(found.past.longer, options);
  state.memory.long_per_step = found.past.longer.per_step;
  return state;
}

/// Whether a view is of no use: a covered lens, an exposure that failed.
bool ShowsNothing(const View& view) {
  constexpr std::size_t kLeastHeld = 20;
  return view.held.size() < kLeastHeld;
}

/// Whether a frame is the newest one kept once more, bit for bit as far as the method looks.
bool Repeats(const DenseFrame& now, const DenseFrame& last) {
  const auto same = [](const cv::Mat1b& a, const cv::Mat1b& b) {
    return cv::norm(a, b, cv::NORM_INF) == 0;
  };
  return same(now.image, last.image) && same(now.right_low, last.right_low) &&
         same(now.right_high, last.right_high);
}

/// Whether the camera delivers an old picture while the rig goes on. Equal pictures alone do not
/// say so: without noise a rig that stands has them. What tells is that no vehicle could have
/// stopped so, or that its motion is measured and is none of standing; of a picture known to be
/// old, further copies are as old, whatever the rig could have done by then.
bool IsStuck(const RobustState& before, const DenseFrame& now,
             const std::vector<EgoMotion>& motions, const std::optional<MotionPrior>& prior) {
  if (before.stuck_at) return Repeats(now, *before.stuck_at);
  if (motions.empty() || !prior) return false;
  const bool has_moved =
      !IsPossible(Isometry3d::Identity(), *prior) || (prior->measured && !motions[0].standing);
  return has_moved && Repeats(now, before.frames.back());
}

/// The usual time from one frame to the next, seconds; nothing of a single frame.
std::optional<double> UsualStep(const std::vector<DenseFrame>& frames) {
  if (frames.size() < 2) return std::nullopt;
  const DenseFrame &first = frames.front(), &last = frames.back();
  return SecondsBetween(first.stamp_ns, last.stamp_ns) / (last.number - first.number);
}

/// Whether it is too long since the newest frame kept for its past to tell of the present: who
/// moved is elsewhere, and how the rig has gone on is a guess that grows with the square of time,
/// under which anything would be possible. If the whole way is known, as wheels measure it, what
/// stands is still known to stand, and the frame is as good as the oldest that are compared.
bool IsOver(const RobustState& before, std::int64_t stamp_ns, bool way_is_known) {
  constexpr double kLongest_s = 0.5;       // in which who walks goes half a metre
  constexpr double kLongestKnown_s = 3;    // kLongestGap, at 20 frames a second
  constexpr double kFewSteps = 3;          // a slow camera has lost two frames by then
  constexpr double kLongestFirst_s = 1.5;  // nobody knows yet how slow it is: at 1 Hz, and late
  const std::optional<double> step_s = UsualStep(before.frames);
  const double longest_s = std::max(way_is_known ? kLongestKnown_s : kLongest_s,
                                    step_s ? kFewSteps * *step_s : kLongestFirst_s);
  return SecondsBetween(before.stamp_ns, stamp_ns) > longest_s;
}

/// A state without a past. What was learned of the camera stays, and what it has been stuck at; no
/// region is given an id that another one had.
RobustState Anew(const RobustState& before, cv::Size half) {
  RobustState state;
  state.stuck_at = before.stuck_at;
  state.noise = before.noise;
  state.memory = ForgottenMemory(half, before.memory.regions.next_id);
  return state;
}

/// The state after a frame that showed nothing, or an old picture: what was known stays, and the
/// rig goes on as expected, until that IsOver. Kept among the others it would testify that nothing
/// moves, as nothing does in it, and that all surfaces are others.
RobustState PassOver(const RobustState& before, const std::optional<MotionPrior>& prior,
                     std::int64_t stamp_ns, cv::Size half) {
  if (!prior || IsOver(before, stamp_ns, false)) return Anew(before, half);
  RobustState state = before;
  state.unseen_way = MeasuredMotion{prior->T_now_before, prior->covariance};
  return state;
}

/// The stages of a frame that is not compared.
RobustStages StagesOf(const View& view, std::map<std::string, double> stage_ms) {
  RobustStages stages;
  stages.half_disparity = view.frame.disparity;
  stages.stage_ms = std::move(stage_ms);
  return stages;
}

/// What a frame says that shows nothing.
RobustResult WithoutContent(RobustState state, const View& view, cv::Size image,
                            std::map<std::string, double> stage_ms) {
  return {.state = std::move(state),
          .dynamic = {cv::Mat1b(cv::Mat1b::zeros(image)), {}},
          .probability = cv::Mat1f(image, 0.0F),
          .motion = std::nullopt,
          .half_disparity = view.frame.disparity,
          .stages = StagesOf(view, std::move(stage_ms))};
}

/// What a frame says that is an old picture: as much as is known of its pixels already.
RobustResult OnceMore(RobustState state, const View& view, const PixelLabels& labels,
                      std::map<std::string, double> stage_ms) {
  state.stuck_at = view.frame;
  return {.state = std::move(state),
          .dynamic = labels.dynamic,
          .probability = labels.probability,
          .motion = std::nullopt,
          .half_disparity = view.frame.disparity,
          .stages = StagesOf(view, std::move(stage_ms))};
}

/// What a step has found, for people to look at.
RobustStages StagesOf(const Found& found, std::map<std::string, double> stage_ms) {
  RobustStages stages{.half_disparity = found.view.frame.disparity,
                      .gaps = {},
                      .floor = found.layout.floor,
                      .floor_mask = found.layout.floor_mask,
                      .evidence = found.past.log_odds,
                      .memory = found.log_odds,
                      .log_odds = found.labels.field,
                      .stage_ms = std::move(stage_ms)};
  for (std::size_t k = 0; k < found.past.gaps.size(); ++k) {
    stages.gaps.push_back({found.flows[k], found.motions.motions[k], found.past.gaps[k]});
  }
  return stages;
}

}  // namespace

RobustResult StepRobust(const RobustState& before, const StereoPair& images, std::int64_t stamp_ns,
                        const KnownMotion& known, const StereoCamera& camera,
                        const RobustOptions& options) {
  CV_Assert(images.left.size() == cv::Size(camera.width, camera.height));
  CV_Assert(images.right.size() == images.left.size());
  CV_Assert(before.frames.empty() || stamp_ns > before.stamp_ns);
  const StereoCamera half = HalfCamera(camera);
  const bool way_is_known = known.measured && !before.unseen_way;
  if (!before.frames.empty() && IsOver(before, stamp_ns, way_is_known)) {
    return StepRobust(Anew(before, {half.width, half.height}), images, stamp_ns, known, camera,
                      options);
  }
  const DisparityTolerance tolerance(options.tolerance, DisparityNoise(before.noise));
  const auto prior = PriorFor(before, stamp_ns, known, options.ego);
  const Isometry3d T_now_before = prior ? prior->T_now_before : Isometry3d::Identity();
  std::map<std::string, double> ms;

  // Stereo: a dense disparity, and what the image has of texture.
  const View view = Timed(ms["disparity"], [&] { return LookAt(images, stamp_ns, options); });

  const auto passed_over = [&] {
    return PassOver(before, prior, stamp_ns, view.frame.image.size());
  };
  if (ShowsNothing(view)) {
    return WithoutContent(passed_over(), view, images.left.size(), std::move(ms));
  }

  const Step step{.before = before,
                  .view = view,
                  .image = images.left.size(),
                  .camera = camera,
                  .half = half,
                  .tolerance = tolerance,
                  .options = options};

  // Flow to frames before, beyond what the expected motion explains.
  const std::vector<GapFlow> flows =
      Timed(ms["flow"], [&] { return FollowGaps(before, view, T_now_before, half, options.flow); });

  // The rig's own motion, by the points that nobody has seen move; beside it, the floor and what
  // hangs together.
  const auto [rig, layout] = Timed(ms["ego_motion"], [&] {
    return InParallel(
        [&] {
          LabelMemory memory = Carried(step, flows);
          GapMotions motions = FindGapMotions(step, flows, memory, prior);
          return std::pair(std::move(memory), std::move(motions));
        },
        [&] { return LayOut(view.frame, camera, tolerance, options); });
  });
  const auto& [memory, motions] = rig;
  const auto label = [&](const cv::Mat1f& log_odds, const PixelRegions& previous) {
    return Timed(ms["label"], [&] { return LabelPixels(step, layout, log_odds, previous); });
  };
  if (IsStuck(before, view.frame, motions.motions, prior)) {
    const PixelLabels same = label(before.memory.log_odds, before.memory.regions);
    return OnceMore(passed_over(), view, same, std::move(ms));
  }

  // For and against motion: what that leaves unexplained, of this frame and of those before.
  const auto [past, log_odds] = Timed(ms["evidence"], [&] {
    PastEvidence said = WeighPast(step, flows, motions.motions, memory);
    cv::Mat1f known = Accumulate(memory.log_odds, said, options.field);
    return std::pair(std::move(said), std::move(known));
  });

  // Neighbours on one surface agree; what moves together is one region.
  const PixelLabels labels = label(log_odds, memory.regions);

  const Found found{view, flows, motions, layout, past, log_odds, labels};
  return {.state = Remember(before, found, options),
          .dynamic = labels.dynamic,
          .probability = labels.probability,
          .motion = motions.motions.empty() ? std::nullopt : std::optional(motions.motions[0]),
          .half_disparity = view.frame.disparity,
          .stages = StagesOf(found, std::move(ms))};
}

}  // namespace aisle::slam::dynamic
