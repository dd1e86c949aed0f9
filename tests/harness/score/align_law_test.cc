// What every alignment must be: of all motions that its method allows, the one that errs least.
#include "harness/score/align.h"

#include <gtest/gtest.h>

#include <random>

namespace aisle {
namespace {

using Random = std::mt19937_64;

/// Normal, of standard deviation 1.
Eigen::Vector3d Scatter(Random* random) {
  std::normal_distribution<double> normal;
  const double x = normal(*random), y = normal(*random), z = normal(*random);
  return {x, y, z};
}

/// A vehicle's drive in an aisle and back on a floor whose height varies by a millimetre, so that
/// noise decides which way up the best fit of positions would lie if it were free to mirror them.
Trajectory FlatDrive() {
  Trajectory drive;
  for (int i = 0; i < 200; ++i) {
    StampedPose pose{i * 50'000'000LL, Eigen::Isometry3d::Identity()};
    pose.T_world_rig.translation() << 0.05 * i, 2 * std::sin(0.03 * i), 0.001 * std::sin(0.5 * i);
    drive.push_back(pose);
  }
  return drive;
}

/// In a world of its own, which stands as the truth's does, each position off by its own error.
Trajectory Estimated(const Trajectory& truth, double noise_m, Random* random) {
  Eigen::Isometry3d T_own_truth = Eigen::Isometry3d::Identity();
  T_own_truth.linear() =
      Eigen::AngleAxisd(3 * Scatter(random).x(), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  T_own_truth.translation() = 10 * Scatter(random);
  Trajectory estimate = truth;
  for (StampedPose& pose : estimate) {
    pose.T_world_rig.translation() += noise_m * Scatter(random);
    pose.T_world_rig = T_own_truth * pose.T_world_rig;
  }
  return estimate;
}

std::vector<PosePair> EachWithItsOwn(const Trajectory& trajectory) {
  std::vector<PosePair> pairs;
  for (std::size_t i = 0; i < trajectory.size(); ++i) pairs.push_back({i, i});
  return pairs;
}

double SquaredError(const Trajectory& truth, const Trajectory& estimate,
                    const Alignment& alignment) {
  double sum = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Eigen::Isometry3d aligned = Apply(alignment, estimate[i].T_world_rig);
    sum += (aligned.translation() - truth[i].T_world_rig.translation()).squaredNorm();
  }
  return sum;
}

constexpr AlignmentMethod kMethods[] = {AlignmentMethod::kNone, AlignmentMethod::kOrigin,
                                        AlignmentMethod::kPosYaw, AlignmentMethod::kSe3,
                                        AlignmentMethod::kSim3};

TEST(AlignLaws, NoDriveIsLaidOnItsTruthByAMirror) {
  const Trajectory truth = FlatDrive();
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Random random(seed);
    const Trajectory estimate = Estimated(truth, 0.005, &random);
    for (const AlignmentMethod method : kMethods) {
      const Alignment alignment =
          Align(truth, estimate, EachWithItsOwn(truth), {.method = method, .first_n = 0});
      const Eigen::Matrix3d R = alignment.T_truth_estimate.linear();
      EXPECT_NEAR(R.determinant(), 1, 1e-9) << Name(method) << seed;
      EXPECT_LT((R.transpose() * R - Eigen::Matrix3d::Identity()).norm(), 1e-9) << Name(method);
      EXPECT_GT(alignment.scale, 0);
      EXPECT_GT(R(2, 2), 0.99) << Name(method) << seed << ": the floor lies on its back";
    }
  }
}

/// No motion undoes a mirror: the least that is left is what the mirror did to the narrowest way.
TEST(AlignLaws, AMirroredTrackStaysMirrored) {
  Trajectory truth;
  for (const Eigen::Vector3d& at :
       {Eigen::Vector3d(4, 0, 0), {-4, 0, 0}, {0, 2, 0}, {0, -2, 0}, {0, 0, 1}, {0, 0, -1}}) {
    StampedPose pose{static_cast<std::int64_t>(truth.size()), Eigen::Isometry3d::Identity()};
    pose.T_world_rig.translation() = at;
    truth.push_back(pose);
  }
  Trajectory mirrored = truth;
  for (StampedPose& pose : mirrored) pose.T_world_rig.translation().z() *= -1;
  for (const AlignmentMethod method : {AlignmentMethod::kSe3, AlignmentMethod::kSim3}) {
    const Alignment alignment =
        Align(truth, mirrored, EachWithItsOwn(truth), {.method = method, .first_n = 0});
    EXPECT_NEAR(alignment.T_truth_estimate.linear().determinant(), 1, 1e-12);
    // By hand (Umeyama's D S with S = diag(1, 1, -1)): spreads 32, 8 and 2 of 42 in all.
    const double scale = method == AlignmentMethod::kSim3 ? (32.0 + 8 - 2) / 42 : 1;
    EXPECT_NEAR(alignment.scale, scale, 1e-12);
    EXPECT_NEAR(SquaredError(truth, mirrored, alignment), 42 * (1 + scale * scale) - 2 * scale * 38,
                1e-9);
  }
}

TEST(AlignLaws, NoMotionNearbyErrsLess) {
  const Trajectory truth = FlatDrive();
  const std::vector<PosePair> pairs = EachWithItsOwn(truth);
  Random random(1);
  for (int round = 0; round < 20; ++round) {
    const Trajectory estimate = Estimated(truth, 0.02, &random);
    for (const AlignmentMethod method :
         {AlignmentMethod::kPosYaw, AlignmentMethod::kSe3, AlignmentMethod::kSim3}) {
      const Alignment best = Align(truth, estimate, pairs, {.method = method, .first_n = 0});
      const double least = SquaredError(truth, estimate, best);
      for (int k = 0; k < 20; ++k) {
        Alignment other = best;
        Eigen::Vector3d turn = 1e-2 * Scatter(&random);
        if (method == AlignmentMethod::kPosYaw) turn.head<2>().setZero();
        other.T_truth_estimate.linear() =
            Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() *
            best.T_truth_estimate.linear();
        other.T_truth_estimate.translation() += 1e-2 * Scatter(&random);
        if (method == AlignmentMethod::kSim3) other.scale *= 1 + 1e-2 * Scatter(&random).x();
        EXPECT_GE(SquaredError(truth, estimate, other), least) << Name(method);
      }
    }
  }
}

}  // namespace
}  // namespace aisle
