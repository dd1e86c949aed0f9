#include "slam/dynamic/robust/robust_method.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <opencv2/imgproc.hpp>

#include "slam/dynamic/common/stopwatch.h"
#include "slam/dynamic/robust/join_regions.h"
#include "slam/dynamic/robust/label_field.h"
#include "slam/dynamic/robust/motion_evidence.h"
#include "slam/dynamic/robust/residual_flow.h"

namespace aisle::slam::dynamic {
namespace {

using Eigen::Isometry3d;

/// By which measured noise moves the running value, per frame; a longer gap is measured in every
/// second one.
constexpr double kNoiseRate = 0.1, kLongNoiseRate = 1 - (1 - kNoiseRate) * (1 - kNoiseRate);
double NoiseRate(const GapMotion& gap) { return gap.slot == 0 ? kNoiseRate : kLongNoiseRate; }

const MeasurementNoise kLeastNoise(0.1, 0.1, 0.2), kMostNoise(1.0, 1.0, 2.0);  // full pixels

constexpr double kLeastFlowNoise = 0.05, kMostFlowNoise = 0.5;  // half-size pixels

double Seconds(std::int64_t from_ns, std::int64_t to_ns) {
  return static_cast<double>(to_ns - from_ns) * 1e-9;
}

std::optional<MotionPrior> PriorFor(const RobustState& before, std::int64_t stamp_ns,
                                    const std::optional<Isometry3d>& predicted,
                                    const EgoMotionOptions& options) {
  const double step_s = Seconds(before.stamp_ns, stamp_ns);
  MotionPrior prior;
  if (predicted) {
    prior.T_now_before = *predicted;
  } else if (before.T_now_before && before.step_s > 0) {
    const Vector6d motion = Difference(Isometry3d::Identity(), *before.T_now_before);
    prior.T_now_before = Retract(Isometry3d::Identity(), motion * (step_s / before.step_s));
  } else {
    return std::nullopt;
  }
  constexpr double kLeastM = 0.002, kLeastRad = 0.002;  // of the prediction itself
  prior.sigma_m = kLeastM + options.acceleration_mps2 * step_s * step_s;
  prior.sigma_rad = kLeastRad + options.angular_acceleration_radps2 * step_s * step_s;
  return prior;
}

struct Seen {
  DenseFrame frame;
  Texture texture;
  FlowPyramid pyramid;
  Surroundings around;
};

Seen See(const StereoPair& images, std::int64_t stamp_ns, const RobustOptions& options) {
  Seen seen;
  tbb::parallel_invoke(
      [&] {
        seen.frame = MakeDenseFrame(images.left, images.right, options.disparity, options.surface);
        seen.frame.stamp_ns = stamp_ns;
        seen.around = LookAround(seen.frame, options.surface, options.evidence);
      },
      [&] {
        const cv::Mat1b half = HalfImage(images.left);
        seen.texture = MeasureTexture(half, options.surface);
        seen.pyramid = MakeFlowPyramid(half, options.flow);
      });
  return seen;
}

const DenseFrame& FrameAgo(const RobustState& state, int gap) {
  return state.frames[state.frames.size() - static_cast<std::size_t>(gap)];
}

/// The rig's motion since the frame a gap ago, if the latest step was T_now_before.
Isometry3d MotionOver(int gap, const RobustState& before, const Isometry3d& T_now_before) {
  return T_now_before * before.frames.back().T_world_rig.inverse() *
         FrameAgo(before, gap).T_world_rig;
}

/// Of the gaps that the past reaches back to the shortest, and of the longer ones each in its turn:
/// what they say changes little from frame to frame.
std::vector<GapMotion> GapsInTurn(const RobustState& before) {
  std::vector<GapMotion> gaps;
  const auto past = std::ssize(before.frames);
  if (past < kGaps[0]) return gaps;
  gaps.push_back({0, kGaps[0], {}, {}, {}, {}, {}});
  std::size_t slot = before.long_slot % (kGaps.size() - 1) + 1;
  if (past < kGaps[slot]) slot = 1;
  if (past >= kGaps[slot]) gaps.push_back({slot, kGaps[slot], {}, {}, {}, {}, {}});
  return gaps;
}

/// The flow over these gaps.
std::vector<GapMotion> FollowGaps(const RobustState& before, const Seen& seen,
                                  const Isometry3d& T_now_before, const StereoCamera& half,
                                  const ResidualFlowOptions& options) {
  std::vector<GapMotion> gaps = GapsInTurn(before);
  tbb::parallel_for(std::size_t{0}, gaps.size(), [&](std::size_t k) {
    const Isometry3d expected = MotionOver(gaps[k].gap, before, T_now_before);
    gaps[k].expected = WhereStatic(seen.frame.filled, expected.inverse(), half).place;
    gaps[k].flow = FollowBack(seen.frame.image, seen.pyramid, FrameAgo(before, gaps[k].gap).image,
                              gaps[k].expected, options);
  });
  return gaps;
}

using GapMatches = std::array<std::vector<StereoMatch>, kGaps.size()>;

/// Finds the rig's motion over every gap; the longer ones start from what the frames between have
/// said. Drops the gaps from the first on whose motion cannot be found.
GapMatches FindGapMotions(std::vector<GapMotion>& gaps, const RobustState& before, const Seen& seen,
                          const LabelMemory& memory, const std::optional<MotionPrior>& prior,
                          const StereoCamera& camera, const EgoMotionOptions& options) {
  EgoMotionOptions narrow = options;
  narrow.rounds = 1;  // the frames between have left little to find
  const auto points = WellHeld(seen.texture, seen.frame.disparity, options.cell_px);
  GapMatches matches;
  tbb::parallel_for(std::size_t{0}, gaps.size(), [&](std::size_t k) {
    matches[k] = MatchesAlong(points, gaps[k].flow, gaps[k].expected, seen.frame,
                              FrameAgo(before, gaps[k].gap), memory);
  });
  if (gaps.empty()) return matches;
  gaps[0].motion = EstimateEgoMotion(matches[0], camera, prior, before.noise[0], options);
  tbb::parallel_for(std::size_t{1}, gaps.size(), [&](std::size_t k) {
    const Isometry3d expected = MotionOver(gaps[k].gap, before, gaps[0].motion.T_now_before);
    gaps[k].motion =
        RefineEgoMotion(matches[k], camera, expected, before.noise[gaps[k].slot], narrow);
  });
  const auto lost = std::find_if(gaps.begin(), gaps.end(),
                                 [](const GapMotion& gap) { return !gap.motion.found; });
  gaps.erase(lost, gaps.end());
  return matches;
}

void LearnNoise(RobustState& state, const std::vector<GapMotion>& gaps, const GapMatches& matches,
                const StereoCamera& camera) {
  tbb::parallel_for(std::size_t{0}, gaps.size(), [&](std::size_t k) {
    const auto measured = MeasureNoise(matches[k], camera, gaps[k].motion.T_now_before);
    if (!measured) return;
    const MeasurementNoise bounded = measured->cwiseMax(kLeastNoise).cwiseMin(kMostNoise);
    MeasurementNoise& noise = state.noise[gaps[k].slot];
    noise += NoiseRate(gaps[k]) * (bounded - noise);
  });
}

/// What speaks for motion that has ended, down to nothing known.
void ForgetEnded(const cv::Mat1f& ended, cv::Mat1f& log_odds) {
  tbb::parallel_for(0, log_odds.rows, [&](int y) {
    const float* off = ended[y];
    float* known = log_odds[y];
    for (int x = 0; x < log_odds.cols; ++x) {
      known[x] = known[x] > 0 ? std::max(known[x] - off[x], 0.0F) : known[x];
    }
  });
}

cv::Mat1f CompareWithPast(std::vector<GapMotion>& gaps, RobustState& state,
                          const RobustState& before, LabelMemory& memory, const Seen& seen,
                          const StereoCamera& half, const RobustOptions& options) {
  if (gaps.empty()) return cv::Mat1f(seen.frame.image.size(), 0.0F);
  std::vector<cv::Mat1f> evidence(kGaps.size());
  std::vector<cv::Mat2f> per_step(kGaps.size());
  if (before.long_slot > 0) {
    evidence[before.long_slot] = memory.long_log_odds;
    per_step[before.long_slot] = memory.long_per_step;
  }
  LatestStep latest;
  for (GapMotion& gap : gaps) {
    const DenseFrame& then = FrameAgo(before, gap.gap);
    const Comparison comparison{seen.frame,
                                then,
                                gap.flow,
                                gap.motion.T_now_before.inverse(),
                                Seconds(then.stamp_ns, seen.frame.stamp_ns),
                                before.flow_noise[gap.slot],
                                memory.regions.labels,
                                memory.log_odds};
    const MotionEvidence found =
        CompareMotion(comparison, seen.texture, seen.around, half, options.evidence);
    gap.evidence = evidence[gap.slot] = found.log_odds;
    gap.per_step = per_step[gap.slot] = found.step.residual / gap.gap;
    if (gap.slot == 0) latest = found.step;
    if (!found.flow_noise) continue;
    const double bounded = std::clamp(*found.flow_noise, kLeastFlowNoise, kMostFlowNoise);
    double& noise = state.flow_noise[gap.slot];
    noise += NoiseRate(gap) * (bounded - noise);
  }
  cv::Mat1f ended(seen.frame.image.size(), 0.0F);
  for (std::size_t slot = 1; slot < kGaps.size(); ++slot) {
    if (evidence[slot].empty()) continue;
    TakeOffEndedMotion(latest, seen.texture, per_step[slot], options.evidence,
                       options.evidence.most[slot], evidence[slot], ended);
  }
  ForgetEnded(ended, memory.log_odds);
  return CombineGaps(evidence, options.evidence);
}

/// What a gap says in the next frame, where another one has its turn: it fades as memory does.
cv::Mat1f ToCarry(const GapMotion& gap, const RobustOptions& options) {
  cv::Mat1f carried;
  cv::max(gap.evidence, options.evidence.least[gap.slot], carried);
  cv::min(carried, options.evidence.most[gap.slot], carried);
  carried *= options.field.memory;
  return carried;
}

/// What the labelling has to know of the current frame, whatever moves.
struct Scene {
  std::optional<FloorPlane> floor;
  cv::Mat1b floor_mask;
  Links links;
  cv::Mat1f farthest;  // how far a label may grow, half-size pixels
};

Scene LookAtScene(const DenseFrame& frame, const StereoCamera& camera,
                  const RobustOptions& options) {
  Scene scene;
  scene.floor = FindFloor(frame.disparity, options.floor);
  scene.floor_mask = FloorMask(frame.filled, scene.floor);
  scene.links = LinkPixels(frame.filled, frame.image, scene.floor_mask, options.field);
  frame.filled.convertTo(scene.farthest, CV_32F, options.field.grow_m / camera.baseline_m);
  return scene;
}

/// What leans to static, added.
cv::Mat1f Leaning(const cv::Mat1f& log_odds, const cv::Mat1f& disparity, const cv::Mat1b& floor,
                  const FieldOptions& options) {
  cv::Mat1f leaning;
  cv::add(log_odds, options.bias, leaning);
  const auto unknown = static_cast<float>(options.unknown_bias),
             on_floor = static_cast<float>(options.floor_bias);
  tbb::parallel_for(0, leaning.rows, [&](int y) {
    const float* known = disparity[y];
    float* lean = leaning[y];
    for (int x = 0; x < leaning.cols; ++x) lean[x] += known[x] <= 0 ? unknown : 0.0F;
    for (int x = 0; x < leaning.cols; ++x) {
      if (floor(y, x) != 0) lean[x] = std::min(lean[x], 0.0F) + on_floor;
    }
  });
  return leaning;
}

cv::Mat1b PixelMask(const PixelRegions& regions, cv::Size image) {
  cv::Mat1b half, mask;
  cv::compare(regions.labels, 0, half, cv::CMP_GT);
  cv::resize(half, mask, image, 0, 0, cv::INTER_LINEAR);
  cv::threshold(mask, mask, 127, 255, cv::THRESH_BINARY);
  return mask;
}

cv::Mat1f PixelProbability(const cv::Mat1f& log_odds, cv::Size image) {
  cv::Mat1f odds, probability;
  cv::exp(-log_odds, odds);
  odds = 1 / (1 + odds);
  cv::resize(odds, probability, image, 0, 0, cv::INTER_LINEAR);
  return probability;
}

DynamicRegions ToFullSize(const PixelRegions& regions, const cv::Mat1f& disparity, cv::Size image,
                          const RegionOptions& options) {
  DynamicRegions dynamic;
  dynamic.mask = PixelMask(regions, image);
  for (const PixelRegion& region : JoinRegions(regions, disparity, options)) {
    const cv::Rect box(region.box.tl() * 2, region.box.size() * 2);
    dynamic.regions.push_back({region.id, box & cv::Rect({0, 0}, image), region.log_odds});
  }
  return dynamic;
}

void RememberFrame(std::vector<DenseFrame>& frames, DenseFrame now,
                   const std::vector<GapMotion>& gaps) {
  if (gaps.empty()) {
    frames.clear();  // the way back is lost: a new past begins
  } else {
    now.T_world_rig = Normalized(frames.back().T_world_rig * gaps[0].motion.T_now_before.inverse());
  }
  if (std::ssize(frames) >= kLongestGap) frames.erase(frames.begin());
  frames.push_back(std::move(now));
}

/// Which pixels move, and the regions they make up.
void LabelPixels(const DenseFrame& frame, const Scene& scene, LabelMemory& memory,
                 int& next_region_id, cv::Size image, const RobustOptions& options,
                 RobustResult& result) {
  const cv::Mat1f leaning =
      Leaning(memory.log_odds, frame.disparity, scene.floor_mask, options.field);
  const cv::Mat1f log_odds = SolveField(leaning, scene.links, options.field);
  tbb::parallel_invoke(
      [&] {
        const cv::Mat1b moving = GrowMoving(log_odds, leaning, scene.links, scene.floor_mask,
                                            scene.farthest, options.field);
        memory.regions = FindRegions(moving, memory.log_odds, scene.links, memory.regions,
                                     next_region_id, options.field.coupling, options.region);
        result.dynamic = ToFullSize(memory.regions, frame.disparity, image, options.region);
      },
      [&] { result.probability = PixelProbability(log_odds, image); });
  result.stages.log_odds = log_odds;
}

/// The state for the next step; the last thing to change.
void Remember(RobustState& state, LabelMemory memory, DenseFrame now,
              const std::vector<GapMotion>& gaps, const RobustOptions& options) {
  state.long_slot = gaps.size() > 1 ? gaps.back().slot : 0;
  memory.long_log_odds = state.long_slot > 0 ? ToCarry(gaps.back(), options) : cv::Mat1f();
  memory.long_per_step = state.long_slot > 0 ? gaps.back().per_step : cv::Mat2f();
  state.memory = std::move(memory);
  if (!gaps.empty()) {
    state.T_now_before = gaps[0].motion.T_now_before;
    state.step_s = Seconds(state.stamp_ns, now.stamp_ns);
  }
  state.stamp_ns = now.stamp_ns;
  RememberFrame(state.frames, std::move(now), gaps);
}

}  // namespace

RobustResult StepRobust(const RobustState& before, const StereoPair& images, std::int64_t stamp_ns,
                        const std::optional<Isometry3d>& predicted, const StereoCamera& camera,
                        const RobustOptions& options) {
  RobustResult result;
  RobustStages& stages = result.stages;
  RobustState state = before;
  const StereoCamera half = HalfCamera(camera);

  const auto prior = PriorFor(before, stamp_ns, predicted, options.ego);
  Seen seen;
  LabelMemory memory = ForgottenMemory(images.left.size() / 2);
  {
    const Stopwatch time(stages.stage_ms["disparity"]);
    seen = See(images, stamp_ns, options);
  }
  {
    const Stopwatch time(stages.stage_ms["flow"]);
    stages.gaps = FollowGaps(before, seen, prior ? prior->T_now_before : Isometry3d::Identity(),
                             half, options.flow);
  }
  Scene scene;
  {
    const Stopwatch time(stages.stage_ms["ego_motion"]);
    tbb::parallel_invoke(
        [&] {
          if (!stages.gaps.empty()) {
            memory =
                CarryMemory(before.memory, stages.gaps[0].flow, seen.frame, before.frames.back());
          }
          const GapMatches matches =
              FindGapMotions(stages.gaps, before, seen, memory, prior, camera, options.ego);
          LearnNoise(state, stages.gaps, matches, camera);
        },
        [&] { scene = LookAtScene(seen.frame, camera, options); });
  }
  {
    const Stopwatch time(stages.stage_ms["evidence"]);
    stages.evidence = CompareWithPast(stages.gaps, state, before, memory, seen, half, options);
    memory.log_odds = options.field.memory * memory.log_odds + stages.evidence;
    memory.log_odds = cv::min(cv::max(memory.log_odds, -options.field.limit), options.field.limit);
  }
  {
    const Stopwatch time(stages.stage_ms["label"]);
    LabelPixels(seen.frame, scene, memory, state.next_region_id, images.left.size(), options,
                result);
    stages.half_disparity = seen.frame.disparity;
    stages.floor = scene.floor;
    stages.floor_mask = scene.floor_mask;
    stages.memory = memory.log_odds;
  }
  Remember(state, std::move(memory), std::move(seen.frame), stages.gaps, options);
  result.state = std::move(state);
  return result;
}

}  // namespace aisle::slam::dynamic
