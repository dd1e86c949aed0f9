#include "slam/dynamic/robust_method.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <opencv2/imgproc.hpp>

#include "slam/dynamic/disparity.h"
#include "slam/dynamic/label_field.h"
#include "slam/dynamic/spread_features.h"
#include "slam/dynamic/stopwatch.h"

namespace aisle::slam::dynamic {
namespace {

using Eigen::Isometry3d;

constexpr int kNodePixels = 2 * kNodeHalfPixels;
constexpr double kTrackMemory = 0.9;  // share of a track's log-odds that survives a frame
constexpr double kTrackLimit = 8;     // of a track's log-odds
constexpr double kNoiseRate = 0.1;    // by which measured noise moves the running value, per frame
constexpr double kRegionTrust = 0.1;  // in points of what moved a frame ago, as static points
const MeasurementNoise kLeastNoise(0.08, 0.08, 0.1), kMostNoise(1.0, 1.0, 1.5);  // pixels

struct Seen {
  DenseFrame dense;
  std::vector<PointTrack> tracks;
};

/// Disparity on the one hand, points on the other: neither needs the other until both are there.
Seen See(const RobustState& before, const StereoPair& images, const RobustOptions& options,
         std::map<std::string, double>& stage_ms, int& next_track_id) {
  Seen seen;
  double& dense_ms = stage_ms["disparity"];
  double& flow_ms = stage_ms["flow"];
  std::vector<cv::Point2f> corners;
  tbb::parallel_invoke(
      [&] {
        const Stopwatch time(dense_ms);
        cv::Mat1b left, right;
        cv::resize(images.left, left, images.left.size() / 2, 0, 0, cv::INTER_AREA);
        cv::resize(images.right, right, left.size(), 0, 0, cv::INTER_AREA);
        seen.dense = MakeDenseFrame(left, ComputeDisparity(left, right, options.disparity));
      },
      [&] {
        const Stopwatch time(flow_ms);
        if (!before.left.empty()) {
          seen.tracks = FollowTracks(before.tracks, before.left, images.left, options.points);
        }
        corners = SpreadFeatures(images.left, options.points.spread);
      });
  const Stopwatch time(stage_ms["points"]);
  StartTracks(seen.tracks, corners, images.left.size(), next_track_id, options.points);
  MeasureDisparities(seen.tracks, images.left, images.right, seen.dense.disparity, options.points);
  return seen;
}

/// How far a track is trusted to be static: by what is known of it, of the place where it was, and
/// by how long it has been seen.
double TrustIn(const PointTrack& track, int gap, const NodeRegions& regions_before) {
  const double age = (track.age + 1.0) / (track.age + 4.0);
  const double trust = age / (1 + std::exp(track.log_odds));
  if (gap != 1 || regions_before.labels.empty()) return trust;
  const Eigen::Vector3d& then = track.seen[track.seen.size() - 2];
  const cv::Point node(
      std::clamp(static_cast<int>(then.x()) / kNodePixels, 0, regions_before.labels.cols - 1),
      std::clamp(static_cast<int>(then.y()) / kNodePixels, 0, regions_before.labels.rows - 1));
  return regions_before.labels(node) > 0 ? kRegionTrust * trust : trust;
}

std::vector<StereoMatch> MatchesOver(int gap, const std::vector<PointTrack>& tracks,
                                     const NodeRegions& regions_before) {
  std::vector<StereoMatch> matches;
  for (const PointTrack& track : tracks) {
    const Eigen::Vector3d* then = track.Before(gap);
    if (then == nullptr) continue;
    matches.push_back({*then, track.now(), TrustIn(track, gap, regions_before)});
  }
  return matches;
}

std::optional<MotionPrior> PriorFor(const RobustState& before, std::int64_t stamp_ns,
                                    const std::optional<Isometry3d>& predicted,
                                    const EgoMotionOptions& options) {
  const double step_s = static_cast<double>(stamp_ns - before.stamp_ns) * 1e-9;
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

/// The rig's motion over every gap that the past reaches back to, the shortest first; the longer
/// ones start from what the frames between have said.
std::vector<GapMotion> FindGapMotions(const RobustState& before,
                                      const std::vector<PointTrack>& tracks,
                                      const std::optional<MotionPrior>& prior,
                                      const StereoCamera& camera, const EgoMotionOptions& options) {
  std::vector<GapMotion> gaps;
  for (std::size_t k = 0; k < kGaps.size(); ++k) {
    if (std::ssize(before.frames) < kGaps[k]) break;
    GapMotion gap{kGaps[k], {}, before.noise[k]};
    const auto matches = MatchesOver(gap.gap, tracks, before.memory.regions);
    if (gap.gap == 1) {
      gap.motion = EstimateEgoMotion(matches, camera, prior, gap.noise, options);
    } else {
      const auto& newest = before.frames.back();
      const auto& then = before.frames[before.frames.size() - static_cast<std::size_t>(gap.gap)];
      gap.motion = RefineEgoMotion(
          matches, camera,
          gaps[0].motion.T_now_before * newest.T_world_rig.inverse() * then.T_world_rig, gap.noise,
          options);
    }
    if (!gap.motion.found) break;
    gaps.push_back(gap);
  }
  return gaps;
}

template <typename Noise>
Noise Towards(const Noise& from, const Noise& to) {
  return from + kNoiseRate * (to - from);
}

void LearnNoise(RobustState& state, const std::vector<GapMotion>& gaps,
                const StereoCamera& camera) {
  for (std::size_t k = 0; k < gaps.size(); ++k) {
    const auto measured =
        MeasureNoise(state.tracks, camera, gaps[k].gap, gaps[k].motion.T_now_before);
    if (!measured) continue;
    state.noise[k] = Towards(
        state.noise[k], MeasurementNoise(measured->cwiseMax(kLeastNoise).cwiseMin(kMostNoise)));
  }
}

/// A window on an outline shows two surfaces and follows neither: what it says counts for nothing.
void SilencePointsOnEdges(std::vector<double>& evidence, const std::vector<PointTrack>& tracks,
                          const cv::Mat1b& half_edge) {
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const cv::Point half(
        std::clamp(static_cast<int>(tracks[i].now().x()) / 2, 0, half_edge.cols - 1),
        std::clamp(static_cast<int>(tracks[i].now().y()) / 2, 0, half_edge.rows - 1));
    if (half_edge(half) != 0) evidence[i] = 0;
  }
}

/// Whether the window around a point shows a corner rather than an edge: along an edge a point is
/// not held by anything, and on noise that stands still in the image it would stand still too.
bool IsCorner(const cv::Mat1b& image, const Eigen::Vector3d& at, const PointTrackOptions& options) {
  const int radius = options.flow.window_px / 2;
  const cv::Rect area =
      cv::Rect(cvRound(at.x()) - radius, cvRound(at.y()) - radius, 2 * radius + 1, 2 * radius + 1) &
      cv::Rect(1, 1, image.cols - 2, image.rows - 2);
  double xx = 0, xy = 0, yy = 0;
  for (int y = area.y; y < area.y + area.height; ++y) {
    for (int x = area.x; x < area.x + area.width; ++x) {
      const int gx = image(y, x + 1) - image(y, x - 1), gy = image(y + 1, x) - image(y - 1, x);
      xx += gx * gx;
      xy += gx * gy;
      yy += gy * gy;
    }
  }
  const double half = (xx + yy) / 2, root = std::hypot((xx - yy) / 2, xy);
  const double noise = options.brightness_noise * cv::mean(image(area))[0];
  const double of_noise = 2 * noise * noise * area.area();  // what it adds to xx and yy
  return half - root >= std::max(options.cornerness * (half + root), 2 * of_noise) && half > 0;
}

/// A window on an edge slides along it: what it says of motion counts for nothing.
void SilenceSlidingPoints(std::vector<double>& evidence, const std::vector<PointTrack>& tracks,
                          const cv::Mat1b& left, const PointTrackOptions& options) {
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (evidence[i] > 0 && !IsCorner(left, tracks[i].now(), options)) evidence[i] = 0;
  }
}

/// The largest evidence if the longest gap that speaks at all speaks of motion, else the mean: what
/// moves has moved farther over a longer gap, and what has not was misjudged over the short one.
float Combine(const std::vector<cv::Mat1f>& gaps, int k) {
  float largest = 0, sum = 0, longest = 0;
  int known = 0;
  for (const cv::Mat1f& gap : gaps) {
    if (gap(k) == 0) continue;
    largest = std::max(largest, gap(k));
    sum += gap(k);
    longest = gap(k);
    ++known;
  }
  if (known == 0) return 0;
  return longest > 0 ? largest : sum / static_cast<float>(known);
}

cv::Mat1f CompareWithPast(RobustState& state, const DenseFrame& now, const RobustState& before,
                          const std::vector<GapMotion>& gaps, const StereoCamera& half,
                          const EvidenceOptions& options) {
  const cv::Size nodes(now.image.cols / kNodeHalfPixels, now.image.rows / kNodeHalfPixels);
  std::vector<cv::Mat1f> evidence(gaps.size());
  for (std::size_t k = 0; k < gaps.size(); ++k) {
    const auto& then = before.frames[before.frames.size() - static_cast<std::size_t>(gaps[k].gap)];
    const DenseEvidence dense = CompareWithEarlier(now, then, gaps[k].motion.T_now_before.inverse(),
                                                   half, before.dense_noise[k], options);
    evidence[k] =
        cv::min(cv::max(dense.log_odds, options.dense_static[k]), options.dense_dynamic[k]);
    if (!dense.noise_known) continue;
    DenseNoise& noise = state.dense_noise[k];
    noise.intensity = std::clamp(Towards(noise.intensity, dense.measured.intensity), 0.5, 20.0);
    noise.disparity_px =
        std::clamp(Towards(noise.disparity_px, dense.measured.disparity_px), 0.05, 1.0);
  }
  cv::Mat1f combined(nodes, 0.0F);
  for (int k = 0; k < static_cast<int>(combined.total()); ++k) combined(k) = Combine(evidence, k);
  return combined;
}

/// Adds the points' evidence to the nodes around them that lie on their surface, fading with
/// distance.
void AddPoints(cv::Mat1f& evidence, const std::vector<PointTrack>& tracks,
               const std::vector<double>& point_evidence, const cv::Mat1f& node_disparity,
               const FieldOptions& options) {
  const int reach = cvCeil(options.point_reach_px / kNodePixels);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const Eigen::Vector3d& now = tracks[i].now();
    if (!(now.z() > 0) || point_evidence[i] == 0) continue;
    const cv::Point centre(static_cast<int>(now.x()) / kNodePixels,
                           static_cast<int>(now.y()) / kNodePixels);
    const cv::Rect area =
        cv::Rect(centre.x - reach, centre.y - reach, 2 * reach + 1, 2 * reach + 1) &
        cv::Rect({0, 0}, evidence.size());
    for (int y = area.y; y < area.y + area.height; ++y) {
      for (int x = area.x; x < area.x + area.width; ++x) {
        const double d = 2 * node_disparity(y, x);
        const double tolerance = options.disparity_px + options.disparity_share * d;
        if (std::abs(d - now.z()) > tolerance) continue;
        const double far =
            cv::norm(cv::Point(x, y) - centre) * kNodePixels / options.point_reach_px;
        evidence(y, x) += static_cast<float>(point_evidence[i] * std::exp(-far * far));
      }
    }
  }
}

std::vector<PointVote> VotesOf(const std::vector<PointTrack>& tracks, const StereoCamera& camera,
                               const std::vector<GapMotion>& gaps) {
  std::vector<PointVote> votes;
  for (const PointTrack& track : tracks) {
    PointVote vote{{static_cast<int>(track.now().x()) / kNodePixels,
                    static_cast<int>(track.now().y()) / kNodePixels},
                   track.log_odds};
    for (const GapMotion& gap : gaps) {  // the longest that is known: the least noise a frame
      const Eigen::Vector3d* before = track.Before(gap.gap);
      if (before == nullptr) continue;
      vote.drift = (Backproject(camera, track.now()) -
                    gap.motion.T_now_before * Backproject(camera, *before)) /
                   gap.gap;
    }
    votes.push_back(vote);
  }
  return votes;
}

cv::Mat1b PixelMask(const NodeRegions& regions, cv::Size image, int dilate_nodes) {
  cv::Mat1b nodes;
  cv::compare(regions.labels, 0, nodes, cv::CMP_GT);
  if (dilate_nodes > 0) {
    const int side = 2 * dilate_nodes + 1;
    cv::dilate(nodes, nodes, cv::getStructuringElement(cv::MORPH_ELLIPSE, {side, side}));
  }
  cv::Mat1b mask(image);
  for (int y = 0; y < image.height; ++y) {
    const unsigned char* row = nodes[std::min(y / kNodePixels, nodes.rows - 1)];
    for (int x = 0; x < image.width; ++x) {
      mask(y, x) = row[std::min(x / kNodePixels, nodes.cols - 1)];
    }
  }
  return mask;
}

cv::Mat1f PixelProbability(const cv::Mat1f& log_odds, cv::Size image) {
  cv::Mat1f nodes(log_odds.size());
  for (int k = 0; k < static_cast<int>(nodes.total()); ++k) {
    nodes(k) = 1 / (1 + std::exp(-log_odds(k)));
  }
  cv::Mat1f probability;
  cv::resize(nodes, probability, image, 0, 0, cv::INTER_LINEAR);
  return probability;
}

DynamicRegions ToPixels(const NodeRegions& regions, cv::Size image, int dilate_nodes) {
  DynamicRegions dynamic;
  dynamic.mask = PixelMask(regions, image, dilate_nodes);
  const cv::Rect frame({0, 0}, image);
  for (const NodeRegion& region : regions.regions) {
    const cv::Rect box(kNodePixels * (region.box.x - dilate_nodes),
                       kNodePixels * (region.box.y - dilate_nodes),
                       kNodePixels * (region.box.width + 2 * dilate_nodes),
                       kNodePixels * (region.box.height + 2 * dilate_nodes));
    dynamic.regions.push_back({region.id, box & frame, region.log_odds});
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

}  // namespace

RobustResult StepRobust(const RobustState& before, const StereoPair& images, std::int64_t stamp_ns,
                        const std::optional<Isometry3d>& predicted, const StereoCamera& camera,
                        const RobustOptions& options) {
  RobustResult result;
  RobustStages& stages = result.stages;
  RobustState& state = result.state;
  state = before;
  const StereoCamera half = HalfCamera(camera);

  Seen seen = See(before, images, options, stages.stage_ms, state.next_track_id);
  state.tracks = std::move(seen.tracks);
  {
    const Stopwatch time(stages.stage_ms["ego_motion"]);
    const auto prior = PriorFor(before, stamp_ns, predicted, options.ego);
    stages.gaps = FindGapMotions(before, state.tracks, prior, camera, options.ego);
    LearnNoise(state, stages.gaps, camera);
    stages.point_evidence = PointEvidence(state.tracks, camera, stages.gaps, options.evidence);
    SilencePointsOnEdges(stages.point_evidence, state.tracks, seen.dense.edge);
    SilenceSlidingPoints(stages.point_evidence, state.tracks, images.left, options.points);
    for (std::size_t i = 0; i < state.tracks.size(); ++i) {
      double& log_odds = state.tracks[i].log_odds;
      log_odds =
          std::clamp(kTrackMemory * log_odds + stages.point_evidence[i], -kTrackLimit, kTrackLimit);
    }
  }
  {
    const Stopwatch time(stages.stage_ms["dense"]);
    stages.dense_evidence =
        CompareWithPast(state, seen.dense, before, stages.gaps, half, options.evidence);
  }
  const Stopwatch time(stages.stage_ms["label"]);
  const cv::Mat1f node_disparity = NodeDisparity(seen.dense.disparity);
  const Isometry3d T_before_now =
      stages.gaps.empty() ? Isometry3d::Identity() : stages.gaps[0].motion.T_now_before.inverse();
  LabelMemory memory = CarryMemory(before.memory, RegionFlows(before.memory.regions, state.tracks),
                                   node_disparity, T_before_now, half);
  memory.log_odds = options.field.memory * memory.log_odds + stages.dense_evidence;
  AddPoints(memory.log_odds, state.tracks, stages.point_evidence, node_disparity, options.field);
  memory.log_odds = cv::min(cv::max(memory.log_odds, -options.field.limit), options.field.limit);

  cv::Mat1f leaning;
  cv::add(memory.log_odds, options.field.bias, leaning);
  stages.log_odds = SolveField(leaning, LinkNodes(node_disparity, seen.dense.image, options.field),
                               options.field);
  memory.regions = FindRegions(stages.log_odds, VotesOf(state.tracks, camera, stages.gaps),
                               memory.regions, state.next_region_id, options.region);

  result.dynamic = ToPixels(memory.regions, images.left.size(), options.region.dilate_nodes);
  result.probability = PixelProbability(stages.log_odds, images.left.size());
  stages.half_disparity = seen.dense.disparity;
  stages.tracks = state.tracks;

  state.memory = std::move(memory);
  state.left = images.left;
  if (!stages.gaps.empty()) {
    state.T_now_before = stages.gaps[0].motion.T_now_before;
    state.step_s = static_cast<double>(stamp_ns - before.stamp_ns) * 1e-9;
  }
  state.stamp_ns = stamp_ns;
  RememberFrame(state.frames, std::move(seen.dense), stages.gaps);
  return result;
}

}  // namespace aisle::slam::dynamic
