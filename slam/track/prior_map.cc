#include "slam/track/prior_map.h"

#include "slam/optimize/observations_of.h"
#include "slam/track/predict_motion.h"

namespace aisle::slam {
namespace {

/// What should be seen of the landmarks that keyframes before `first_of_drive` have brought.
std::vector<Expected> ExpectOfPriorMap(const PlainContext& context, const TrackMemory& memory,
                                       const Eigen::Isometry3d& T_rig_world,
                                       KeyframeId first_of_drive) {
  std::vector<Expected> expected = ExpectAround(context, memory, T_rig_world);
  std::erase_if(expected,
                [&](const Expected& one) { return one.landmark->created_by >= first_of_drive; });
  return expected;
}

}  // namespace

std::optional<PoseInPriorMap> FindInPriorMap(const PlainContext& context, const TrackMemory& memory,
                                             KeyframeId first_of_drive) {
  const auto& [map, frame, camera, levels, options, right, masked] = context;
  const Eigen::Isometry3d T_predicted_world =
      ReckonedPose(map, memory, frame.stamp_ns, options).inverse();
  FramePose found;
  found.matches = MatchByProjection(
      frame, ExpectOfPriorMap(context, memory, T_predicted_world, first_of_drive), options.motion);
  found.pose = RefinePose(camera, T_predicted_world, ObservationsOf(map, frame, found.matches), {});
  const double least =
      std::max<double>(options.least_map_inliers,
                       options.prior_map_share * static_cast<double>(found.matches.size()));
  if (found.pose.inliers < least || !found.pose.well_posed) return std::nullopt;
  Sharpen(context, {}, &found);
  return PoseInPriorMap{memory.reference,
                        (found.pose.T_rig_world * map.PoseOf(memory.reference)).inverse(),
                        found.pose.covariance};
}

Eigen::Isometry3d PoseOf(const PoseInPriorMap& found, const Map& map) {
  return map.PoseOf(found.reference) * found.T_reference_rig;
}

std::optional<MeasuredMotion> MotionInPriorMap(const Map& map, const PoseInPriorMap& before,
                                               const PoseInPriorMap& now,
                                               const std::optional<MeasuredMotion>& expected,
                                               const InertiaOptions& options) {
  const Eigen::Isometry3d T_now_before = PoseOf(now, map).inverse() * PoseOf(before, map);
  const MeasuredMotion motion =
      Compose({Eigen::Isometry3d::Identity(), before.covariance}, {T_now_before, now.covariance});
  if (expected && Chi2Between(motion, *expected) > options.most_chi2) return std::nullopt;
  return motion;
}

}  // namespace aisle::slam
