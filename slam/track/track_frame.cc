#include "slam/track/track_frame.h"

#include <algorithm>

#include "slam/map/match_keyframe.h"

namespace aisle::slam {
namespace {

/// What every step of finding one frame looks at.
struct Scene {
  const Map& map;
  const Frame& frame;
  const StereoCamera& camera;
  int levels;
  const TrackOptions& options;
};

std::vector<PointObservation> Observations(const Scene& scene, const std::vector<Match>& matches) {
  std::vector<PointObservation> observations;
  for (const Match& match : matches) {
    observations.push_back({scene.map.At(match.landmark).position,
                            scene.frame.measurements[static_cast<std::size_t>(match.feature)]});
  }
  return observations;
}

std::vector<LandmarkId> Inliers(const std::vector<Match>& matches, const RefinedPose& pose) {
  std::vector<LandmarkId> inliers;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (pose.inlier[i]) inliers.push_back(matches[i].landmark);
  }
  return inliers;
}

/// A first pose and the landmarks that support it.
struct FirstPose {
  Eigen::Isometry3d T_rig_world;
  std::vector<LandmarkId> landmarks;
};

std::optional<FirstPose> FollowLandmarks(const Scene& scene,
                                         const std::vector<LandmarkId>& landmarks,
                                         const Eigen::Isometry3d& T_rig_world, double widen) {
  std::vector<Expected> expected;
  for (const LandmarkId id : landmarks) {
    const Landmark* landmark = scene.map.Find(id);
    if (!landmark) continue;
    const auto one = Expect(*landmark, scene.camera, T_rig_world, scene.frame.scale, scene.levels);
    if (one) expected.push_back(*one);
  }
  MatchOptions match_options = scene.options.motion;
  match_options.radius_px *= widen;
  const std::vector<Match> matches = MatchByProjection(scene.frame, expected, {}, match_options);
  if (std::ssize(matches) < scene.options.least_motion_matches) return std::nullopt;
  const RefinedPose pose = RefinePose(scene.camera, T_rig_world, Observations(scene, matches), {});
  if (pose.inliers < scene.options.least_inliers || !pose.well_posed) return std::nullopt;
  return FirstPose{pose.T_rig_world, Inliers(matches, pose)};
}

std::optional<FirstPose> RecogniseKeyframe(const Scene& scene, KeyframeId id) {
  const Keyframe* keyframe = scene.map.Find(id);
  if (!keyframe) return std::nullopt;
  const std::vector<Match> matches =
      MatchKeyframe(scene.map, *keyframe, scene.frame, scene.options.keyframe_distance,
                    scene.options.keyframe_ratio);
  const auto pose = AlignPoints(scene.camera, Observations(scene, matches), scene.options.align);
  if (!pose) return std::nullopt;
  return FirstPose{pose->T_rig_world, Inliers(matches, *pose)};
}

/// Looks for everything around the first pose and refines it with what is found.
std::optional<FramePose> RefineInLocalMap(const Scene& scene, const FirstPose& first) {
  FramePose result;
  result.local = FindLocalMap(scene.map, first.landmarks, scene.options.local_keyframes);
  std::vector<Expected> expected;
  for (const Landmark* landmark : result.local.landmarks) {
    const auto one =
        Expect(*landmark, scene.camera, first.T_rig_world, scene.frame.scale, scene.levels);
    if (!one) continue;
    expected.push_back(*one);
    result.expected.push_back(landmark->id);
  }
  result.matches = MatchByProjection(scene.frame, expected, {}, scene.options.local_map);
  result.pose =
      RefinePose(scene.camera, first.T_rig_world, Observations(scene, result.matches), {});
  if (result.pose.inliers < scene.options.least_map_inliers || !result.pose.well_posed) {
    return std::nullopt;
  }
  return result;
}

/// Whether the rig can have come from where it was predicted to where it was found.
bool IsNear(const Eigen::Isometry3d& T_predicted_world, const Eigen::Isometry3d& T_found_world,
            double gap_s, const DeadReckoningOptions& reckoning) {
  const Vector6d off = Difference(T_predicted_world, T_found_world);
  return off.head<3>().norm() <= reckoning.drift_m_per_s * gap_s &&
         off.tail<3>().norm() * 180 / M_PI <= reckoning.drift_deg_per_s * gap_s;
}

}  // namespace

std::optional<FramePose> TrackFrame(const Map& map, const Frame& frame, const TrackMemory& memory,
                                    const StereoCamera& camera, int levels,
                                    const TrackOptions& options) {
  const Scene scene{map, frame, camera, levels, options};
  const Eigen::Isometry3d T_world_last = map.PoseOf(memory.reference) * memory.T_reference_rig;
  const double gap_s = static_cast<double>(frame.stamp_ns - memory.stamp_ns) * 1e-9;
  const bool gap_is_short = gap_s <= options.longest_gap_s;
  const Eigen::Isometry3d T_predicted_world =
      PredictPose(T_world_last, gap_is_short ? memory.motion : std::nullopt, gap_s).inverse();
  const Eigen::Isometry3d T_last_world = T_world_last.inverse();

  // Repeated structure makes a wrong pose look right to a few dozen points: one that explains too
  // little of what should be seen gives way to one that explains enough. Only to such a one: where
  // a person hides most of the map, whatever follows the person may explain a little more.
  std::optional<FramePose> best;
  const auto attempt = [&](const std::optional<FirstPose>& first) {
    std::optional<FramePose> found = first ? RefineInLocalMap(scene, *first) : std::nullopt;
    const bool convincing =
        found && found->pose.inliers >=
                     options.convincing_share * static_cast<double>(found->expected.size());
    if (convincing || !best) best = std::move(found);
    return convincing;
  };
  if (attempt(FollowLandmarks(scene, memory.landmarks, T_predicted_world, 1))) return best;
  // The rig has stopped, or turned on the spot.
  if (attempt(FollowLandmarks(scene, memory.landmarks, T_last_world, options.wide_factor))) {
    return best;
  }
  attempt(RecogniseKeyframe(scene, memory.reference));
  return best;
}

std::optional<FramePose> FindAgain(const Map& map, const Frame& frame, const TrackMemory& memory,
                                   const StereoCamera& camera, int levels,
                                   const TrackOptions& options) {
  const DeadReckoningOptions& reckoning = options.dead_reckoning;
  const double gap_s = static_cast<double>(frame.stamp_ns - memory.stamp_ns) * 1e-9;
  if (!memory.steady_motion || gap_s <= 0 || gap_s > reckoning.longest_s) return std::nullopt;
  const Eigen::Isometry3d T_world_last = map.PoseOf(memory.reference) * memory.T_reference_rig;
  const Eigen::Isometry3d T_predicted_world =
      PredictPose(T_world_last, memory.steady_motion, gap_s).inverse();
  std::vector<Expected> expected;
  for (const Landmark* landmark :
       FindLocalMap(map, memory.landmarks, options.local_keyframes).landmarks) {
    const auto one = Expect(*landmark, camera, T_predicted_world, frame.scale, levels);
    if (one) expected.push_back(*one);
  }

  TrackOptions relaxed = options;
  relaxed.least_map_inliers = reckoning.least_inliers;
  const Scene scene{map, frame, camera, levels, relaxed};
  for (const double grown_px : {0.0, reckoning.radius_growth_px_per_s * gap_s}) {
    MatchOptions match_options = reckoning.match;
    match_options.radius_px += grown_px;
    const std::vector<Match> matches = MatchByProjection(frame, expected, {}, match_options);
    const auto pose = AlignPoints(camera, Observations(scene, matches), reckoning.align);
    if (!pose) continue;
    auto found = RefineInLocalMap(scene, {pose->T_rig_world, Inliers(matches, *pose)});
    if (found && IsNear(T_predicted_world, found->pose.T_rig_world, gap_s, reckoning) &&
        found->pose.inliers >=
            reckoning.least_share * static_cast<double>(found->expected.size())) {
      return found;
    }
  }
  return std::nullopt;
}

std::optional<FramePose> LocateByKeyframe(const Map& map, const Frame& frame, KeyframeId keyframe,
                                          const StereoCamera& camera, int levels,
                                          const TrackOptions& options) {
  const Scene scene{map, frame, camera, levels, options};
  const auto first = RecogniseKeyframe(scene, keyframe);
  return first ? RefineInLocalMap(scene, *first) : std::nullopt;
}

}  // namespace aisle::slam
