#include "slam/optimize/align_points.h"

#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "slam/common/mix.h"

namespace aisle::slam {
namespace {

/// The rigid motion that carries `from` onto `to` (columns) in the least-squares sense (Horn 1987;
/// solved by SVD).
Eigen::Isometry3d RigidMotion(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to) {
  const Eigen::Vector3d from_mean = from.rowwise().mean(), to_mean = to.rowwise().mean();
  const Eigen::Matrix3d correlation =
      (to.colwise() - to_mean) * (from.colwise() - from_mean).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(correlation,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double handedness = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = svd.matrixU() * Eigen::Vector3d(1, 1, handedness < 0 ? -1 : 1).asDiagonal() *
                    svd.matrixV().transpose();
  motion.translation() = to_mean - motion.linear() * from_mean;
  return motion;
}

/// Three different indices below `count`.
std::array<std::size_t, 3> DrawThree(std::size_t count, std::uint64_t seed, int hypothesis) {
  std::array<std::size_t, 3> drawn{};
  std::uint64_t counter = static_cast<std::uint64_t>(hypothesis) * 64;
  for (std::size_t i = 0; i < 3; ++i) {
    do {
      drawn[i] = Mix(kGolden * (seed + 1) + counter++) % count;
    } while ((i > 0 && drawn[i] == drawn[0]) || (i > 1 && drawn[i] == drawn[1]));
  }
  return drawn;
}

}  // namespace

std::optional<RefinedPose> AlignPoints(const StereoCamera& camera,
                                       const std::vector<PointObservation>& observations,
                                       const AlignPointsOptions& options) {
  std::vector<const PointObservation*> deep;  // with depth
  for (const PointObservation& observation : observations) {
    if (observation.measurement.has_depth() && observation.measurement.uvd.z() > 0)
      deep.push_back(&observation);
  }
  // Near points make better hypotheses: keep those whose depth is known to a twentieth, if they do.
  const auto is_vague = [](const PointObservation* observation) {
    return DisparitySigma(observation->measurement) > 0.05 * observation->measurement.uvd.z();
  };
  const auto vague = std::stable_partition(deep.begin(), deep.end(), std::not_fn(is_vague));
  if (vague - deep.begin() >= options.least_inliers) deep.erase(vague, deep.end());
  if (deep.size() < 3 || std::ssize(observations) < options.least_inliers) return std::nullopt;

  int most = 0, needed = options.hypotheses;
  Eigen::Isometry3d best = Eigen::Isometry3d::Identity();
  for (int hypothesis = 0; hypothesis < needed; ++hypothesis) {
    Eigen::Matrix3d world, rig;
    const std::array<std::size_t, 3> drawn = DrawThree(deep.size(), options.seed, hypothesis);
    for (int i = 0; i < 3; ++i) {
      const PointObservation& observation = *deep[drawn[static_cast<std::size_t>(i)]];
      world.col(i) = observation.point;
      rig.col(i) = Backproject(camera, observation.measurement.uvd);
    }
    const Eigen::Isometry3d T_rig_world = RigidMotion(world, rig);
    int support = 0;
    for (const PointObservation& observation : observations) {
      support += Chi2(camera, T_rig_world, observation) <=
                 options.chi2_slack * Chi2Bound(observation.measurement);
    }
    if (support <= most) continue;
    most = support;
    best = T_rig_world;
    const double all_good = std::pow(most / static_cast<double>(observations.size()), 3);
    const double draws = std::log(1 - options.confidence) / std::log1p(-std::min(all_good, 0.9999));
    // Little support asks for more draws than an integer counts.
    const double more = std::min(std::ceil(draws), static_cast<double>(options.hypotheses));
    needed = std::min(options.hypotheses, hypothesis + 1 + static_cast<int>(more));
  }
  if (most < 3) return std::nullopt;
  std::vector<PointObservation> supporting;
  for (const PointObservation& observation : observations) {
    if (Chi2(camera, best, observation) <=
        options.chi2_slack * Chi2Bound(observation.measurement)) {
      supporting.push_back(observation);
    }
  }
  const Eigen::Isometry3d near = RefinePose(camera, best, supporting, {}).T_rig_world;
  const RefinedPose refined = RefinePose(camera, near, observations, {.trust_start = true});
  if (refined.inliers < options.least_inliers || !refined.well_posed) return std::nullopt;
  return refined;
}

}  // namespace aisle::slam
