#include "slam/track/track_frame.h"

#include <numbers>
#include <set>

#include "slam/common/seconds.h"
#include "slam/map/landmarks_of.h"
#include "slam/map/match_keyframe.h"
#include "slam/optimize/align_points.h"
#include "slam/optimize/observations_of.h"
#include "slam/track/align_matches.h"

namespace aisle::slam {
namespace {

/// A first pose and the landmarks that support it.
struct FirstPose {
  Eigen::Isometry3d T_rig_world;
  std::vector<LandmarkId> landmarks;
};

std::optional<FirstPose> FollowLandmarks(const PlainContext& context,
                                         const std::vector<LandmarkId>& landmarks,
                                         const Eigen::Isometry3d& T_rig_world, double widen) {
  const std::vector<Expected> expected =
      ExpectAll(FindAll(context.map, landmarks), context.camera, T_rig_world, context.frame.scale,
                context.levels);
  MatchOptions match_options = context.options.motion;
  match_options.radius_px *= widen;
  const std::vector<Match> matches = MatchByProjection(context.frame, expected, match_options);
  if (std::ssize(matches) < context.options.least_motion_matches) return std::nullopt;
  const RefinedPose pose = RefinePose(context.camera, T_rig_world,
                                      ObservationsOf(context.map, context.frame, matches), {});
  if (pose.inliers < context.options.least_inliers || !pose.well_posed) return std::nullopt;
  return FirstPose{pose.T_rig_world, Inliers(matches, pose)};
}

std::optional<FirstPose> RecogniseKeyframe(const PlainContext& context, KeyframeId id) {
  const Keyframe* keyframe = context.map.Find(id);
  if (!keyframe) return std::nullopt;
  const std::vector<Match> matches =
      MatchKeyframe(context.map, *keyframe, context.frame, context.options.keyframe_distance,
                    context.options.keyframe_ratio);
  const auto pose = AlignPoints(context.camera, ObservationsOf(context.map, context.frame, matches),
                                context.options.align);
  if (!pose) return std::nullopt;
  return FirstPose{pose->T_rig_world, Inliers(matches, *pose)};
}

std::optional<FramePose> RefineAround(const PlainContext& context, const FirstPose& first) {
  return RefineInLocalMap(context, first.T_rig_world, first.landmarks, {});
}

/// The landmarks that the frame should show. What lies behind a mover is found all the same where
/// the pose that expects it there is a little off.
std::vector<LandmarkId> Unmasked(const PlainContext& context, const std::vector<Expected>& expected,
                                 const std::vector<Match>& matches) {
  std::set<LandmarkId> found;
  for (const Match& match : matches) found.insert(match.landmark);
  const auto is_masked = [&](const Expected& one) {
    const cv::Point pixel(cvRound(one.uvd.x()), cvRound(one.uvd.y()));
    return context.masked && context.masked->Contains(pixel, one.level) &&
           !found.contains(one.landmark->id);
  };
  std::vector<LandmarkId> unmasked;
  for (const Expected& one : expected) {
    if (!is_masked(one)) unmasked.push_back(one.landmark->id);
  }
  return unmasked;
}

/// The frame with what the landmarks that the pose keeps have been found to measure. Other features
/// may become landmarks of their own, where they are themselves.
std::shared_ptr<const Frame> WithMeasurements(const std::shared_ptr<const Frame>& frame,
                                              const FramePose& pose) {
  if (pose.measurements.empty() || frame->patches.empty()) return frame;
  auto measured = std::make_shared<Frame>(*frame);
  for (std::size_t i = 0; i < pose.matches.size(); ++i) {
    if (!pose.pose.inlier[i]) continue;
    measured->measurements[static_cast<std::size_t>(pose.matches[i].feature)] =
        pose.measurements[i];
  }
  return measured;
}

/// Where the steady motion leads after a while without sight: T_rig_world.
std::optional<Eigen::Isometry3d> DeadReckoned(const PlainContext& context,
                                              const TrackMemory& memory) {
  const double gap_s = SecondsBetween(memory.stamp_ns, context.frame.stamp_ns);
  const bool known =
      memory.steady_motion && gap_s > 0 && gap_s <= context.options.dead_reckoning.longest_s;
  if (!known) return std::nullopt;
  return PredictPose(memory.PoseIn(context.map), memory.steady_motion, gap_s).inverse();
}

/// Whether the rig can have come from where it was predicted to where it was found.
bool IsNear(const Eigen::Isometry3d& T_predicted_world, const Eigen::Isometry3d& T_found_world,
            double gap_s, const DeadReckoningOptions& reckoning) {
  const Vector6d off = Difference(T_predicted_world, T_found_world);
  return off.head<3>().norm() <= reckoning.drift_m_per_s * gap_s &&
         off.tail<3>().norm() * 180 / std::numbers::pi <= reckoning.drift_deg_per_s * gap_s;
}

}  // namespace

std::vector<Expected> ExpectAround(const PlainContext& context, const TrackMemory& memory,
                                   const Eigen::Isometry3d& T_rig_world) {
  const auto& [map, frame, camera, levels, options, right, masked] = context;
  return ExpectAll(FindLocalMap(map, memory.landmarks, options.local_keyframes).landmarks, camera,
                   T_rig_world, frame.scale, levels);
}

std::vector<LandmarkId> Inliers(const std::vector<Match>& matches, const RefinedPose& pose) {
  return InliersOfBoth(matches, {}, pose);
}

std::optional<FramePose> RefineInLocalMap(const PlainContext& context,
                                          const Eigen::Isometry3d& T_rig_world,
                                          const std::vector<LandmarkId>& landmarks,
                                          const RefinePoseOptions& refine) {
  FramePose result;
  result.local = FindLocalMap(context.map, landmarks, context.options.local_keyframes);
  const std::vector<Expected> expected = ExpectAll(
      result.local.landmarks, context.camera, T_rig_world, context.frame.scale, context.levels);
  result.matches = MatchByProjection(context.frame, expected, context.options.local_map);
  result.expected = Unmasked(context, expected, result.matches);
  result.in_view = static_cast<int>(expected.size());
  result.right_matches = MatchRight(context, expected, result.matches, context.options.local_map);
  result.pose =
      RefinePose(context.camera, T_rig_world,
                 ObservationsOfBoth(context, result.matches, result.right_matches), refine);
  if (result.pose.inliers < context.options.least_map_inliers || !result.pose.well_posed) {
    return std::nullopt;
  }
  Sharpen(context, refine, &result);
  return result;
}

void Sharpen(const PlainContext& context, const RefinePoseOptions& refine, FramePose* found) {
  constexpr double kStillAgree = 0.7;
  if (context.frame.patches.empty()) return;
  std::vector<Measurement> measurements =
      AlignMatches(context, found->pose.T_rig_world, found->matches);
  RefinedPose sharp = RefinePose(
      context.camera, found->pose.T_rig_world,
      ObservationsOfBoth(context, measurements, found->matches, found->right_matches), refine);
  const double enough = std::max(kStillAgree * found->pose.inliers,
                                 static_cast<double>(context.options.least_map_inliers));
  if (!sharp.well_posed || sharp.inliers < enough) return;
  found->pose = std::move(sharp);
  found->measurements = std::move(measurements);
}

int LeftInliers(const FramePose& found) {
  return static_cast<int>(Inliers(found.matches, found.pose).size());
}

bool IsConvincing(const FramePose& found, const TrackOptions& options) {
  return found.pose.inliers >= options.convincing_share * found.in_view;
}

std::optional<FramePose> TrackFrame(const PlainContext& context, const TrackMemory& memory) {
  const auto& [map, frame, camera, levels, options, right, masked] = context;
  const Eigen::Isometry3d T_world_last = memory.PoseIn(map);
  const double gap_s = SecondsBetween(memory.stamp_ns, frame.stamp_ns);
  const bool gap_is_short = gap_s <= options.longest_gap_s;
  const Eigen::Isometry3d T_predicted_world =
      PredictPose(T_world_last, gap_is_short ? memory.motion : std::nullopt, gap_s).inverse();
  const Eigen::Isometry3d T_last_world = T_world_last.inverse();

  // Repeated structure makes a wrong pose look right to a few dozen points: one that explains too
  // little of what should be seen gives way to one that explains enough. Only to such a one: where
  // a person hides most of the map, whatever follows the person may explain a little more.
  std::optional<FramePose> best;
  const auto attempt = [&](const std::optional<FirstPose>& first) {
    std::optional<FramePose> found = first ? RefineAround(context, *first) : std::nullopt;
    const bool convincing = found && IsConvincing(*found, options);
    if (convincing || !best) best = std::move(found);
    return convincing;
  };
  if (attempt(FollowLandmarks(context, memory.landmarks, T_predicted_world, 1))) return best;
  // The rig has stopped, or turned on the spot.
  if (attempt(FollowLandmarks(context, memory.landmarks, T_last_world, options.wide_factor))) {
    return best;
  }
  attempt(RecogniseKeyframe(context, map.StandIn(memory.reference)));
  return best;
}

bool CanBeThere(const PlainContext& context, const TrackMemory& memory, const FramePose& found) {
  const double gap_s = SecondsBetween(memory.stamp_ns, context.frame.stamp_ns);
  const auto T_predicted_world = DeadReckoned(context, memory);
  return !T_predicted_world ||
         IsNear(*T_predicted_world, found.pose.T_rig_world, gap_s, context.options.dead_reckoning);
}

std::optional<FramePose> FindAgain(const PlainContext& context, const TrackMemory& memory) {
  const auto& [map, frame, camera, levels, options, right, masked] = context;
  const DeadReckoningOptions& reckoning = options.dead_reckoning;
  const double gap_s = SecondsBetween(memory.stamp_ns, frame.stamp_ns);
  const auto reckoned = DeadReckoned(context, memory);
  if (!reckoned) return std::nullopt;
  const Eigen::Isometry3d& T_predicted_world = *reckoned;
  const std::vector<Expected> expected = ExpectAround(context, memory, T_predicted_world);

  TrackOptions relaxed = options;
  relaxed.least_map_inliers = reckoning.least_inliers;
  const PlainContext relaxed_context{map, frame, camera, levels, relaxed, right, masked};
  for (const double grown_px : {0.0, reckoning.radius_growth_px_per_s * gap_s}) {
    MatchOptions match_options = reckoning.match;
    match_options.radius_px += grown_px;
    const std::vector<Match> matches = MatchByProjection(frame, expected, match_options);
    const auto pose = AlignPoints(camera, ObservationsOf(map, frame, matches), reckoning.align);
    if (!pose) continue;
    auto found = RefineInLocalMap(relaxed_context, pose->T_rig_world, Inliers(matches, *pose), {});
    if (found && IsNear(T_predicted_world, found->pose.T_rig_world, gap_s, reckoning) &&
        found->pose.inliers >= reckoning.least_share * found->in_view) {
      return found;
    }
  }
  return std::nullopt;
}

Keyframe KeyframeOf(const Map& map, const std::shared_ptr<const Frame>& frame,
                    const FramePose& pose) {
  Keyframe keyframe;
  keyframe.id = map.NextKeyframeId();
  keyframe.frame = WithMeasurements(frame, pose);
  keyframe.T_world_rig = Normalized(pose.pose.T_rig_world.inverse());
  keyframe.parent = pose.local.reference;
  keyframe.landmarks.resize(static_cast<std::size_t>(frame->size()));
  for (std::size_t i = 0; i < pose.matches.size(); ++i) {
    const Match& match = pose.matches[i];
    if (pose.pose.inlier[i]) {
      keyframe.landmarks[static_cast<std::size_t>(match.feature)] = match.landmark;
    }
  }
  return keyframe;
}

FramePose PoseOfKeyframe(const Map& map, KeyframeId id) {
  const Keyframe& keyframe = map.At(id);
  FramePose pose;
  pose.pose.T_rig_world = keyframe.T_world_rig.inverse();
  pose.local.reference = id;
  for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
    const LandmarkId landmark = keyframe.landmarks[i];
    if (landmark.valid()) pose.matches.push_back({landmark, static_cast<int>(i), 0});
  }
  pose.pose.inliers = static_cast<int>(pose.matches.size());
  pose.pose.inlier.assign(pose.matches.size(), true);
  return pose;
}

std::optional<FramePose> LocateByKeyframe(const PlainContext& context, KeyframeId keyframe) {
  const auto first = RecogniseKeyframe(context, keyframe);
  return first ? RefineAround(context, *first) : std::nullopt;
}

}  // namespace aisle::slam
