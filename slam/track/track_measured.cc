#include "slam/track/track_measured.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

namespace aisle::slam {
namespace {

/// Where the rig is measured to be, and how sure that is.
struct Reckoned {
  Eigen::Isometry3d T_rig_world;
  Matrix6d covariance;
};

Reckoned ReckonedFrom(const Map& map, const TrackMemory& memory, const MeasuredMotion& way) {
  return {way.T_now_before * memory.PoseIn(map).inverse(), way.covariance};
}

/// Pixels by which a landmark at middle distance may be off by the error of the measured pose.
double SearchGrowth(const PlainContext& context, const Reckoned& reckoned) {
  constexpr double kNear_m = 2, kDeviations = 3;
  const double metres = std::sqrt(reckoned.covariance.topLeftCorner<3, 3>().diagonal().maxCoeff());
  const double radians =
      std::sqrt(reckoned.covariance.bottomRightCorner<3, 3>().diagonal().maxCoeff());
  return kDeviations * context.camera.fx * (metres / kNear_m + radians);
}

/// Of a pose that the images alone have told: both err independently.
bool AgreesWithReckoned(const FramePose& found, const Reckoned& reckoned, double most_chi2) {
  return Chi2Between({reckoned.T_rig_world, reckoned.covariance},
                     {found.pose.T_rig_world, found.pose.covariance}) <= most_chi2;
}

/// A covariance by its directions, in which all of another one's deviations are one.
Eigen::SelfAdjointEigenSolver<Matrix6d> ByDeviationsOf(const Eigen::LLT<Matrix6d>& by,
                                                       const Matrix6d& covariance) {
  const Matrix6d half = by.matrixL().solve(covariance);
  return Eigen::SelfAdjointEigenSolver<Matrix6d>(by.matrixL().solve(half.transpose()));
}

/// Of a pose in which the reckoned one has counted itself. They differ by what the images have
/// moved it, whose covariance is the prior's less the posterior's (of a Kalman filter's update):
/// seen by the prior's own deviations, 1 less each eigenvalue of the posterior's.
bool AgreesWithPrior(const FramePose& found, const Reckoned& reckoned, double most_chi2) {
  constexpr double kLeast = 1e-6;  // of a direction in which the images told nothing
  const Vector6d off = Difference(reckoned.T_rig_world, found.pose.T_rig_world);
  const Eigen::LLT<Matrix6d> prior(reckoned.covariance);
  const auto posterior = ByDeviationsOf(prior, found.pose.covariance);
  const Vector6d moved = posterior.eigenvectors().transpose() * prior.matrixL().solve(off);
  const Vector6d told = (1 - posterior.eigenvalues().array()).max(kLeast);
  return (moved.array().square() / told.array()).sum() <= most_chi2;
}

/// Looks for landmarks around where the rig is measured to be. Those vote that agree with that, and
/// it counts itself. Nothing where what they tell contradicts it.
std::optional<FramePose> FindAround(const PlainContext& context, const TrackMemory& memory,
                                    const Reckoned& reckoned) {
  const auto& [map, frame, camera, levels, options, right, masked] = context;
  TrackOptions relaxed = options;
  relaxed.least_map_inliers = options.measured.least_inliers;
  const PlainContext relaxed_context{map, frame, camera, levels, relaxed, right, masked};
  RefinePoseOptions refine;
  refine.prior = {reckoned.T_rig_world, reckoned.covariance.inverse()};

  const std::vector<Expected> expected = ExpectAround(context, memory, reckoned.T_rig_world);
  MatchOptions match = options.motion;
  match.radius_px += SearchGrowth(context, reckoned);
  const std::vector<Match> matches = MatchByProjection(frame, expected, match);
  const std::vector<Match> right_matches = MatchRight(context, expected, matches, match);
  // First only those vote that agree with the measured pose as it is; it may be off by more than
  // they allow.
  for (const bool trusted : {true, false}) {
    refine.trust_start = trusted;
    const RefinedPose first = RefinePose(
        camera, reckoned.T_rig_world, ObservationsOfBoth(context, matches, right_matches), refine);
    if (first.inliers < options.measured.least_inliers) continue;
    refine.trust_start = true;
    auto found = RefineInLocalMap(relaxed_context, first.T_rig_world,
                                  InliersOfBoth(matches, right_matches, first), refine);
    if (found && AgreesWithPrior(*found, reckoned, options.measured.most_chi2)) return found;
  }
  return std::nullopt;
}

/// What a pose stands on.
std::vector<PointObservation> ObservationsOf(const PlainContext& context, const FramePose& found) {
  return found.measurements.empty()
             ? ObservationsOfBoth(context, found.matches, found.right_matches)
             : ObservationsOfBoth(context, found.measurements, found.matches, found.right_matches);
}

/// A pose that the images have told, with where inertia led as one more observation: all that they
/// see of the world may be a strip beside somebody, where a turn looks like a step aside. It has no
/// say where they know every direction better than it does, nor where that leads to a pose that it
/// does not allow, or that few of the landmarks agree with: the rig was jolted, or brakes hard.
FramePose Steadied(const PlainContext& context, const Reckoned& reckoned, FramePose found) {
  constexpr double kStillAgree = 0.9;
  const Eigen::LLT<Matrix6d> prior(reckoned.covariance);
  if (ByDeviationsOf(prior, found.pose.covariance).eigenvalues().maxCoeff() < 1) return found;
  const Matrix6d information = reckoned.covariance.inverse();
  RefinePoseOptions refine{.rounds = 2, .trust_start = true};
  refine.prior = {reckoned.T_rig_world, information};
  RefinedPose steady =
      RefinePose(context.camera, found.pose.T_rig_world, ObservationsOf(context, found), refine);
  const Vector6d off = Difference(reckoned.T_rig_world, steady.T_rig_world);
  const bool allowed = off.dot(information * off) <= context.options.inertia.most_chi2;
  if (allowed && steady.well_posed && steady.inliers >= kStillAgree * found.pose.inliers)
    found.seen = std::exchange(found.pose, std::move(steady));
  return found;
}

/// By their looks keyframes may tell of anywhere; only what agrees is believed. How the rig went
/// when it was last seen says nothing beside that: since then it may have stopped.
std::optional<FramePose> FindByLooks(const PlainContext& context, const TrackMemory& memory,
                                     const Reckoned& reckoned, const Places& places,
                                     std::int64_t turn) {
  return LocateByLooks(context, memory, places, turn, [&](const FramePose& found) {
    return AgreesWithReckoned(found, reckoned, context.options.measured.most_chi2);
  });
}

}  // namespace

std::optional<FramePose> TrackMeasured(const PlainContext& context, const TrackMemory& memory,
                                       const Places& places, std::int64_t turn) {
  const Reckoned reckoned = ReckonedFrom(context.map, memory, *memory.measured);
  const PlainContext left = LeftAlone(context);
  const auto found = FindAround(left, memory, reckoned);
  if (found && IsConvincing(*found, context.options)) return found;
  const auto both = context.right ? FindAround(context, memory, reckoned) : std::nullopt;
  if (both && (!found || both->pose.inliers > found->pose.inliers)) return both;
  return found ? found : FindByLooks(left, memory, reckoned, places, turn);
}

std::optional<FramePose> TrackInPriorMap(const PlainContext& context, const TrackMemory& memory,
                                         const PoseInPriorMap& told) {
  return FindAround(LeftAlone(context), memory,
                    {PoseOf(told, context.map).inverse(), told.covariance});
}

std::optional<FramePose> TrackCarried(const PlainContext& context, const TrackMemory& memory,
                                      const Places& places, std::int64_t turn) {
  const PlainContext left = LeftAlone(context);
  auto found = TrackFrame(left, memory);
  if (!memory.carried) return found;
  const bool convincing = found && IsConvincing(*found, context.options);
  const Reckoned reckoned = ReckonedFrom(context.map, memory, *memory.carried);
  if (convincing && memory.velocity) return Steadied(left, reckoned, std::move(*found));
  if (found && !AgreesWithReckoned(*found, reckoned, context.options.inertia.most_chi2))
    found.reset();
  if (found && convincing) return found;
  auto around = FindAround(context, memory, reckoned);
  if (around && (!found || around->pose.inliers > found->pose.inliers)) return around;
  return found ? found : FindByLooks(left, memory, reckoned, places, turn);
}

}  // namespace aisle::slam
