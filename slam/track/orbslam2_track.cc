#include "slam/track/orbslam2_track.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "slam/map/landmark_view.h"
#include "slam/map/landmarks_of.h"
#include "slam/map/match_keyframe.h"
#include "slam/optimize/align_points.h"
#include "slam/optimize/observations_of.h"
#include "slam/track/orbslam2_local_map.h"
#include "slam/track/orbslam2_match.h"

namespace aisle::slam {
namespace {

constexpr double kNoRatio = std::numeric_limits<double>::infinity();

std::size_t Slot(int index) { return static_cast<std::size_t>(index); }

/// A pose and the matches that it keeps.
struct Supported {
  RefinedPose pose;
  std::vector<Match> matches;
};

RefinedPose Refine(const OrbSlam2Context& context, const Eigen::Isometry3d& T_rig_world,
                   const std::vector<Match>& matches) {
  return RefinePose(context.camera, T_rig_world,
                    ObservationsOf(context.map, context.frame, matches), {.start_anew = true});
}

/// Nothing where too few matches agree or they fix no pose.
std::optional<Supported> RefineFirst(const OrbSlam2Context& context,
                                     const Eigen::Isometry3d& T_rig_world,
                                     const std::vector<Match>& matches) {
  Supported first{Refine(context, T_rig_world, matches), {}};
  if (first.pose.inliers < context.options.least_first_inliers || !first.pose.well_posed) {
    return std::nullopt;
  }
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (first.pose.inlier[i]) first.matches.push_back(matches[i]);
  }
  return first;
}

/// Levels to look for a feature of the last frame on: it is seen larger from nearer.
std::pair<int, int> LevelsAround(int level, double ahead_m, const OrbSlam2Context& context) {
  if (ahead_m > context.camera.baseline_m) return {level, context.levels - 1};
  if (-ahead_m > context.camera.baseline_m) return {0, level};
  return {level - 1, level + 1};
}

/// Those of the matches that turned as most did, from the angles that their landmarks had before.
std::vector<Match> KeepTurnedAlike(const OrbSlam2Context& context,
                                   const std::vector<Match>& matches,
                                   const std::map<LandmarkId, float>& angles_deg) {
  std::vector<float> turns_deg;
  for (const Match& match : matches) {
    turns_deg.push_back(angles_deg.at(match.landmark) -
                        context.frame.features.keypoints[Slot(match.feature)].angle_deg);
  }
  return KeepCommonTurns(matches, turns_deg);
}

std::vector<Match> FollowLastFrame(const OrbSlam2Context& context, const OrbSlam2Memory& memory,
                                   const Eigen::Isometry3d& T_rig_world,
                                   const Eigen::Isometry3d& T_world_last, double radius_px) {
  const Eigen::Isometry3d T_last_rig =
      T_world_last.inverse() * T_rig_world.inverse(Eigen::Isometry);
  const double ahead_m = T_last_rig.translation().z();
  std::vector<Sought> sought;
  for (const Match& match : memory.matches) {
    const Landmark* landmark = context.map.Find(match.landmark);
    if (!landmark) continue;
    const Eigen::Vector3d in_rig = T_rig_world * landmark->position;
    if (in_rig.z() <= 0) continue;
    const Eigen::Vector3d uvd = Project(context.camera, in_rig);
    if (!InImage(context.camera, uvd.x(), uvd.y())) continue;
    const int level = memory.frame->features.keypoints[Slot(match.feature)].level;
    const auto [lowest, highest] = LevelsAround(level, ahead_m, context);
    sought.push_back(
        {landmark, uvd, radius_px * std::pow(context.frame.scale, level), lowest, highest});
  }
  std::vector<bool> taken(Slot(context.frame.size()), false);
  const std::vector<Match> matches =
      MatchInTurn(context.frame, sought, context.options.motion_distance, kNoRatio, taken);

  std::map<LandmarkId, float> angles_deg;
  for (const Match& match : memory.matches) {
    angles_deg[match.landmark] = memory.frame->features.keypoints[Slot(match.feature)].angle_deg;
  }
  return KeepTurnedAlike(context, matches, angles_deg);
}

std::optional<Supported> TrackByMotion(const OrbSlam2Context& context, const OrbSlam2Memory& memory,
                                       const Eigen::Isometry3d& T_world_last) {
  const OrbSlam2Options& options = context.options;
  if (!memory.T_now_before || memory.frames_since_found < options.found_again_frames) {
    return std::nullopt;
  }
  const Eigen::Isometry3d T_rig_world = *memory.T_now_before * T_world_last.inverse();
  for (const double widen : {1, 2}) {
    const std::vector<Match> matches = FollowLastFrame(context, memory, T_rig_world, T_world_last,
                                                       widen * options.motion_radius_px);
    if (std::ssize(matches) < options.least_motion_matches) continue;
    return RefineFirst(context, T_rig_world, matches);
  }
  return std::nullopt;
}

/// Matches by looks, turned alike.
std::vector<Match> MatchLooks(const OrbSlam2Context& context, const Keyframe& keyframe,
                              double ratio) {
  const std::vector<Match> matches = MatchKeyframe(context.map, keyframe, context.frame,
                                                   context.options.reference_distance, ratio);
  std::map<LandmarkId, float> angles_deg;
  for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
    angles_deg[keyframe.landmarks[i]] = keyframe.frame->features.keypoints[i].angle_deg;
  }
  return KeepTurnedAlike(context, matches, angles_deg);
}

std::optional<Supported> TrackByReference(const OrbSlam2Context& context, KeyframeId reference,
                                          const Eigen::Isometry3d& T_world_last) {
  const std::vector<Match> matches =
      MatchLooks(context, context.map.At(reference), context.options.reference_ratio);
  if (std::ssize(matches) < context.options.least_reference_matches) return std::nullopt;
  return RefineFirst(context, T_world_last.inverse(), matches);
}

/// Landmarks that should be seen from a pose, and where; those in `known` left out.
std::vector<Sought> SoughtAround(const OrbSlam2Context& context,
                                 const std::vector<const Landmark*>& landmarks,
                                 const Eigen::Isometry3d& T_rig_world,
                                 const std::vector<Match>& known, double factor) {
  std::vector<LandmarkId> ids;
  for (const Match& match : known) ids.push_back(match.landmark);
  std::ranges::sort(ids);
  const Eigen::Vector3d centre = T_rig_world.inverse(Eigen::Isometry).translation();
  const OrbSlam2Options& options = context.options;
  std::vector<Sought> sought;
  for (const Landmark* landmark : landmarks) {
    if (std::ranges::binary_search(ids, landmark->id)) continue;
    const auto view =
        Expect(*landmark, context.camera, T_rig_world, context.frame.scale, context.levels);
    if (!view) continue;
    const Eigen::Vector3d ray = landmark->position - centre;
    const bool ahead = ray.dot(landmark->normal) > options.ahead_cosine * ray.norm();
    const int level = PredictLevelAbove(*landmark, ray.norm(), context.frame.scale, context.levels);
    const double radius_px = factor * (ahead ? options.ahead_radius_px : options.aside_radius_px);
    sought.push_back(
        {landmark, view->uvd, radius_px * std::pow(context.frame.scale, level), level - 1, level});
  }
  return sought;
}

std::vector<bool> TakenBy(const std::vector<Match>& matches, const Frame& frame) {
  std::vector<bool> taken(Slot(frame.size()), false);
  for (const Match& match : matches) taken[Slot(match.feature)] = true;
  return taken;
}

std::vector<LandmarkId> LandmarksOf(const std::vector<Match>& matches) {
  std::vector<LandmarkId> landmarks;
  for (const Match& match : matches) landmarks.push_back(match.landmark);
  return landmarks;
}

bool ByFeature(const Match& a, const Match& b) { return a.feature < b.feature; }

/// Looks for everything around a first pose, refines it with all of it, and asks for enough.
std::optional<FramePose> TrackLocalMap(const OrbSlam2Context& context, const Supported& first,
                                       bool just_found, bool settling) {
  const OrbSlam2Options& options = context.options;
  FramePose result;
  result.expected = LandmarksOf(first.matches);
  result.local = OrbSlam2LocalMap(context.map, result.expected, options);
  const std::vector<Sought> sought =
      SoughtAround(context, result.local.landmarks, first.pose.T_rig_world, first.matches,
                   just_found ? options.found_again_factor : 1);
  for (const Sought& one : sought) result.expected.push_back(one.landmark->id);
  std::vector<bool> taken = TakenBy(first.matches, context.frame);
  result.matches =
      MatchInTurn(context.frame, sought, options.map_distance, options.map_ratio, taken);
  result.matches.insert(result.matches.end(), first.matches.begin(), first.matches.end());
  std::ranges::sort(result.matches, ByFeature);
  result.pose = Refine(context, first.pose.T_rig_world, result.matches);
  const int least = settling ? options.least_inliers_after_loss : options.least_inliers;
  if (result.pose.inliers < least || !result.pose.well_posed) return std::nullopt;
  return result;
}

/// More matches of a keyframe's landmarks around a pose that has too few.
std::optional<Supported> SearchMore(const OrbSlam2Context& context, const Keyframe& keyframe,
                                    const Supported& first, double radius_px, int distance) {
  std::vector<Sought> sought = SoughtAround(context, FindAll(context.map, keyframe.landmarks),
                                            first.pose.T_rig_world, first.matches, 1);
  for (Sought& one : sought) {
    one.radius_px = radius_px * std::pow(context.frame.scale, one.highest);
    ++one.highest;
  }
  std::vector<bool> taken = TakenBy(first.matches, context.frame);
  std::vector<Match> matches = MatchInTurn(context.frame, sought, distance, kNoRatio, taken);
  matches.insert(matches.end(), first.matches.begin(), first.matches.end());
  std::ranges::sort(matches, ByFeature);
  return RefineFirst(context, first.pose.T_rig_world, matches);
}

std::optional<Supported> RecogniseLost(const OrbSlam2Context& context, const Keyframe& keyframe) {
  const OrbSlam2Options& options = context.options;
  const std::vector<Match> matches = MatchLooks(context, keyframe, options.lost_ratio);
  if (std::ssize(matches) < options.least_lost_matches) return std::nullopt;
  const auto pose = AlignPoints(context.camera, ObservationsOf(context.map, context.frame, matches),
                                options.align);
  if (!pose) return std::nullopt;
  auto found = RefineFirst(context, pose->T_rig_world, matches);
  if (found && found->pose.inliers < options.least_found_inliers) {
    found = SearchMore(context, keyframe, *found, options.wide_radius_px, options.wide_distance);
  }
  if (found && found->pose.inliers < options.least_found_inliers &&
      found->pose.inliers > options.least_narrow_inliers) {
    found =
        SearchMore(context, keyframe, *found, options.narrow_radius_px, options.narrow_distance);
  }
  return found && found->pose.inliers >= options.least_found_inliers ? found : std::nullopt;
}

}  // namespace

std::optional<FramePose> OrbSlam2Track(const OrbSlam2Context& context,
                                       const Eigen::Isometry3d& T_world_last, KeyframeId reference,
                                       const OrbSlam2Memory& memory) {
  std::optional<Supported> first = TrackByMotion(context, memory, T_world_last);
  if (!first) first = TrackByReference(context, reference, T_world_last);
  if (!first) return std::nullopt;
  return TrackLocalMap(context, *first,
                       memory.frames_since_found < context.options.found_again_frames,
                       memory.seconds_since_found < context.options.settles_s);
}

std::optional<FramePose> OrbSlam2Relocalise(const OrbSlam2Context& context,
                                            const std::vector<KeyframeId>& candidates) {
  for (const KeyframeId id : candidates) {
    const Keyframe* keyframe = context.map.Find(id);
    const auto first = keyframe ? RecogniseLost(context, *keyframe) : std::nullopt;
    // Published: the first candidate that holds decides.
    if (first) return TrackLocalMap(context, *first, true, true);
  }
  return std::nullopt;
}

}  // namespace aisle::slam
