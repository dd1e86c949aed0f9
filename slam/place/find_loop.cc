#include "slam/place/find_loop.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "slam/map/landmarks_of.h"
#include "slam/map/match_by_projection.h"
#include "slam/map/match_keyframe.h"
#include "slam/map/with_neighbours.h"
#include "slam/optimize/align_points.h"
#include "slam/optimize/observations_of.h"
#include "slam/place/adjust_loop.h"

namespace aisle::slam {
namespace {

/// Landmarks of a keyframe and of those most covisible with it.
std::vector<LandmarkId> LandmarksAround(const Map& map, KeyframeId id) {
  constexpr int kNeighbours = 5;
  std::vector<KeyframeId> keyframes = {id};
  for (const Covisible& covisible : CovisibleKeyframes(map, id, kLeastCovisible)) {
    if (keyframes.size() <= kNeighbours) keyframes.push_back(covisible.keyframe);
  }
  return LandmarksOf(map, keyframes);
}

/// Metres driven between two keyframes of one part of the map, over the keyframes of that part: of
/// others that were made meanwhile it is not known where they lie.
double PathLength(const Map& map, KeyframeId from, KeyframeId to,
                  const std::map<KeyframeId, KeyframeId>& part_of) {
  double length_m = 0;
  const auto& keyframes = map.keyframes();
  std::optional<Eigen::Vector3d> last;
  for (auto at = keyframes.find(from); at != keyframes.end() && at->first <= to; ++at) {
    if (part_of.at(at->first) != part_of.at(from)) continue;
    const Eigen::Vector3d here = at->second->T_world_rig.translation();
    if (last) length_m += (here - *last).norm();
    last = here;
  }
  return length_m;
}

/// What may have drifted only so far; nothing is known of where two parts of a map lie.
bool IsPlausible(const Map& map, const LoopEdge& loop, const LoopOptions& options) {
  const std::map<KeyframeId, KeyframeId> part_of = Roots(map);
  if (part_of.at(loop.current) != part_of.at(loop.matched)) return true;
  const Eigen::Isometry3d T_found = map.At(loop.matched).T_world_rig * loop.T_matched_current;
  const double shift_m =
      (T_found.translation() - map.At(loop.current).T_world_rig.translation()).norm();
  const double path_m = PathLength(map, loop.matched, loop.current, part_of);
  return shift_m <= options.drift_m + options.drift_share * path_m;
}

bool Agree(const Map& map, const LoopEdge& a, const LoopEdge& b, const LoopOptions& options) {
  if (RootOf(map, a.current) != RootOf(map, b.current)) return false;
  if (RootOf(map, a.matched) != RootOf(map, b.matched)) return false;
  // Compared where the newer keyframe stands: there the corrections must lead to one place.
  const Eigen::Isometry3d& T_world_rig = map.At(a.current).T_world_rig;
  const Eigen::Isometry3d T_a = Correction(map, a) * T_world_rig;
  const Eigen::Isometry3d T_b = Correction(map, b) * T_world_rig;
  const double turn = Eigen::AngleAxisd(T_a.linear().transpose() * T_b.linear()).angle();
  return (T_a.translation() - T_b.translation()).norm() <= options.consistency_m &&
         turn * 180 / std::numbers::pi <= options.consistency_deg;
}

}  // namespace

std::optional<LoopEdge> VerifyLoop(const Map& map, KeyframeId current, KeyframeId matched,
                                   const StereoCamera& camera, int levels,
                                   const LoopOptions& options) {
  const Frame& frame = *map.At(current).frame;
  const std::vector<Match> matches = MatchKeyframe(
      map, map.At(matched), frame, options.descriptor_distance, options.descriptor_ratio);
  const auto first = AlignPoints(camera, ObservationsOf(map, frame, matches), options.align);
  if (!first) return std::nullopt;

  constexpr double kConfirmRatio = 0.9;  // best to second best: it is known by now where to look
  const std::vector<Expected> expected = ExpectAll(FindAll(map, LandmarksAround(map, matched)),
                                                   camera, first->T_rig_world, frame.scale, levels);
  const std::vector<Match> confirmed = MatchByProjection(
      frame, expected, {options.radius_px, options.descriptor_distance, kConfirmRatio});
  const RefinedPose refined = RefinePose(
      camera, first->T_rig_world, ObservationsOf(map, frame, confirmed), {.trust_start = true});
  if (refined.inliers < options.least_inliers || !refined.well_posed) return std::nullopt;
  const auto adjusted =
      AdjustView(map, frame, confirmed, refined.inlier, refined.T_rig_world, camera);
  if (!adjusted || adjusted->inliers < options.least_inliers) return std::nullopt;
  return LoopEdge{current, matched, (adjusted->T_rig_world * map.At(matched).T_world_rig).inverse(),
                  adjusted->inliers};
}

std::optional<LoopEdge> FindLoop(const Map& map, KeyframeId current, const WordVector& words,
                                 const PlaceIndex& index, const StereoCamera& camera, int levels,
                                 const LoopOptions& options) {
  // Whatever shares landmarks is here already; a loop looks nearly as much like here as they do.
  std::set<KeyframeId> here = {current};
  double least_similarity = 1;
  // A neighbour that shares fewer landmarks may look at something else, and so as little alike as
  // any other place. How alike it looks is another matter than whether it is asked for the loop,
  // which LoopOptions::neighbour_shared decides.
  constexpr int kSimilarityFromShared = 30;
  for (const Covisible& covisible : CovisibleKeyframes(map, current, 1)) {
    here.insert(covisible.keyframe);
    const WordVector* neighbour = index.Find(covisible.keyframe);
    if (neighbour && covisible.shared >= kSimilarityFromShared) {
      least_similarity = std::min(least_similarity, Likeness(words, *neighbour));
    }
  }
  const KeyframeId part = RootOf(map, current);
  int recent = 0;
  for (auto newest = map.keyframes().rbegin();
       newest != map.keyframes().rend() && recent < options.recent_keyframes; ++newest, ++recent) {
    if (RootOf(map, newest->first) == part) here.insert(newest->first);
  }
  std::optional<LoopEdge> best;
  int looked_at = 0;
  for (const PlaceMatch& match : index.Query(words)) {
    if (match.similarity < options.similarity_ratio * least_similarity) break;
    if (here.contains(match.keyframe) || !map.Find(match.keyframe)) continue;
    if (looked_at++ == options.candidates) break;
    const auto loop = VerifyLoop(map, current, match.keyframe, camera, levels, options);
    if (loop && (!best || loop->inliers > best->inliers)) best = loop;
  }
  return best;
}

std::vector<LoopEdge> SeenBeside(const Map& map, const LoopEdge& loop, const StereoCamera& camera,
                                 int levels, const LoopOptions& options) {
  std::vector<LoopEdge> seen;
  for (const Covisible& beside : CovisibleKeyframes(map, loop.current, options.neighbour_shared)) {
    const std::int64_t before = loop.current.value - beside.keyframe.value;
    if (before <= 0 || before > options.neighbours) continue;
    const auto same = VerifyLoop(map, beside.keyframe, loop.matched, camera, levels, options);
    if (same) seen.push_back(*same);
  }
  return seen;
}

bool IsOnePlace(const Map& map, const LoopEdge& loop) {
  if (!map.Find(loop.current) || !map.Find(loop.matched)) return false;
  const std::set<KeyframeId> around = WithNeighbours(map, {loop.matched});
  return std::ranges::any_of(
      CovisibleKeyframes(map, loop.current, kLeastCovisible),
      [&](const Covisible& beside) { return around.contains(beside.keyframe); });
}

std::vector<LoopEdge> AgreeingLoops(const Map& map, const std::vector<LoopEdge>& loops,
                                    const LoopOptions& options) {
  std::vector<LoopEdge> agreeing;
  if (loops.empty()) return agreeing;
  const auto exists = [&](const LoopEdge& loop) {
    return map.Find(loop.current) && map.Find(loop.matched);
  };
  const LoopEdge& newest = loops.back();
  if (!exists(newest) || !IsPlausible(map, newest, options)) return agreeing;
  int inliers = 0;
  for (const LoopEdge& loop : loops) {
    if (!exists(loop) || !Agree(map, newest, loop, options)) continue;
    agreeing.push_back(loop);
    inliers += loop.inliers;
  }
  const bool too_few =
      std::ssize(agreeing) < options.consistent_loops || inliers < options.consistent_inliers;
  if (too_few) agreeing.clear();
  return agreeing;
}

}  // namespace aisle::slam
