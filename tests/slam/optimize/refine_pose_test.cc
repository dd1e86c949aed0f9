#include "slam/optimize/refine_pose.h"

#include <gtest/gtest.h>

#include <random>

#include "slam/optimize/align_points.h"
#include "slam/optimize/bundle.h"

namespace aisle::slam {
namespace {

/// Points in front of a rig at a known pose, with their measurements.
struct SyntheticObservations {
  Eigen::Isometry3d T_rig_world;
  std::vector<PointObservation> observations;
};

struct SyntheticOptions {
  int points = 200;
  double noise = 1;          // in deviations of each measurement
  double outliers = 0;       // share of measurements moved far away
  double without_depth = 0;  // share
  bool right = false;        // all by the right camera alone
  unsigned seed = 1;
};

SyntheticObservations MakeObservations(const SyntheticOptions& options) {
  std::mt19937 random(options.seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> normal;
  const StereoCamera camera;
  Vector6d motion;
  for (double& value : motion) value = normal(random);
  SyntheticObservations synthetic;
  synthetic.T_rig_world = Retract(Eigen::Isometry3d::Identity(), motion);
  for (int i = 0; i < options.points; ++i) {
    const double z = 1 + 14 * uniform(random);
    const Eigen::Vector3d uvd(752 * uniform(random), 480 * uniform(random),
                              camera.fx * camera.baseline_m / z);
    PointObservation observation;
    observation.point = synthetic.T_rig_world.inverse() * Backproject(camera, uvd);
    observation.measurement.sigma_px = 0.5 + uniform(random);
    observation.measurement.sigma_d = 0.2 + 0.3 * uniform(random);
    const Eigen::Vector3d sigma(observation.measurement.sigma_px, observation.measurement.sigma_px,
                                observation.measurement.sigma_d);
    observation.measurement.uvd = uvd;
    for (int k = 0; k < 3; ++k) {
      observation.measurement.uvd[k] += options.noise * sigma[k] * normal(random);
    }
    if (uniform(random) < options.outliers)
      observation.measurement.uvd.x() += 30 + 60 * uniform(random);
    if (uniform(random) < options.without_depth) observation.measurement.sigma_d = 0;
    if (options.right) {
      Measurement& seen = observation.measurement;
      seen.uvd = {seen.uvd.x() - uvd.z(), seen.uvd.y(), 0};
      seen.sigma_d = 0;
      seen.right = true;
    }
    synthetic.observations.push_back(observation);
  }
  return synthetic;
}

Eigen::Isometry3d Disturbed(const Eigen::Isometry3d& pose, double translation_m, double turn_rad) {
  Vector6d motion;
  motion << Eigen::Vector3d::Constant(translation_m), Eigen::Vector3d(1, -1, 0.5) * turn_rad;
  return Retract(pose, motion);
}

TEST(RefinePose, EqualColumnsCountTheErrorOfEitherCamera) {
  const StereoCamera camera;
  const Eigen::Vector3d point(0.4, -0.2, 6);
  Measurement measurement{Project(camera, point), 2, 2, 1};
  measurement.uvd += Eigen::Vector3d(3, 1, 0.5);  // right column: 3 - 0.5 off
  const double chi2 = Chi2(camera, Eigen::Isometry3d::Identity(), {point, measurement});
  EXPECT_NEAR(chi2, (3.0 * 3 + 1 * 1 + 2.5 * 2.5) / 4, 1e-9);

  BundleProblem problem;
  problem.poses.resize(1);
  problem.points = {point};
  EXPECT_NEAR(Chi2(problem, MakeObservation(0, 0, measurement)), chi2, 1e-9);
}

TEST(RefinePose, EqualColumnsFindTheLeastSquaresPose) {
  SyntheticObservations synthetic = MakeObservations({.noise = 1});
  for (PointObservation& observation : synthetic.observations) {
    observation.measurement.sigma_d = observation.measurement.sigma_px;
    observation.measurement.u_in_d = 1;
  }
  const RefinedPose refined = RefinePose({}, synthetic.T_rig_world, synthetic.observations, {});
  const auto cost = [&](const Eigen::Isometry3d& pose) {
    double sum = 0;
    for (std::size_t i = 0; i < synthetic.observations.size(); ++i) {
      if (refined.inlier[i]) sum += Chi2({}, pose, synthetic.observations[i]);
    }
    return sum;
  };
  for (int k = 0; k < 6; ++k) {
    for (const double by : {-2e-4, 2e-4}) {
      Vector6d step = Vector6d::Zero();
      step[k] = by;
      EXPECT_GT(cost(Retract(refined.T_rig_world, step)), cost(refined.T_rig_world)) << k;
    }
  }
}

TEST(RefinePose, StartingAnewEveryRoundBeginsAtTheFirstPose) {
  const SyntheticObservations synthetic = MakeObservations({.noise = 0});
  const Eigen::Isometry3d start = Disturbed(synthetic.T_rig_world, 0.3, 0.1);
  const auto error = [&](const RefinePoseOptions& options) {
    const RefinedPose refined = RefinePose({}, start, synthetic.observations, options);
    return Difference(synthetic.T_rig_world, refined.T_rig_world).norm();
  };
  // One step a round: four of them get further than the last one alone.
  EXPECT_LT(error({.iterations = 1}), 0.1 * error({.iterations = 1, .start_anew = true}));
  EXPECT_LT(error({.start_anew = true}), 1e-6);
}

TEST(RefinePose, RecoversTheTruthFromExactObservations) {
  const SyntheticObservations synthetic = MakeObservations({.noise = 0});
  const RefinedPose refined =
      RefinePose({}, Disturbed(synthetic.T_rig_world, 0.1, 0.03), synthetic.observations, {});
  EXPECT_LT(Difference(synthetic.T_rig_world, refined.T_rig_world).norm(), 1e-7);
  EXPECT_EQ(refined.inliers, 200);
  EXPECT_TRUE(refined.well_posed);
}

TEST(RefinePose, TellsOutliersFromInliers) {
  const SyntheticObservations synthetic =
      MakeObservations({.noise = 0.5, .outliers = 0.4, .without_depth = 0.3});
  const RefinedPose refined =
      RefinePose({}, Disturbed(synthetic.T_rig_world, 0.03, 0.01), synthetic.observations, {});
  EXPECT_LT(Difference(synthetic.T_rig_world, refined.T_rig_world).norm(), 0.01);
  EXPECT_GT(refined.inliers, 100);
  EXPECT_LT(refined.inliers, 140);
}

TEST(RefinePose, WorksWithoutAnyDepth) {
  const SyntheticObservations synthetic = MakeObservations({.noise = 0, .without_depth = 1});
  const RefinedPose refined =
      RefinePose({}, Disturbed(synthetic.T_rig_world, 0.05, 0.02), synthetic.observations, {});
  EXPECT_LT(Difference(synthetic.T_rig_world, refined.T_rig_world).norm(), 1e-6);
}

TEST(RefinePose, TheRightCameraAloneIsOffInItsOwnImage) {
  const StereoCamera camera;
  const Eigen::Vector3d point(0.4, -0.2, 6);
  const Eigen::Vector3d there = point - Eigen::Vector3d(camera.baseline_m, 0, 0);
  const Eigen::Vector3d pixel(camera.fx * there.x() / there.z() + camera.cx + 3,
                              camera.fy * there.y() / there.z() + camera.cy + 4, 0);
  const Measurement seen{.uvd = pixel, .sigma_px = 2, .right = true};
  EXPECT_NEAR(Chi2(camera, Eigen::Isometry3d::Identity(), {point, seen}), 25.0 / 4, 1e-9);
}

TEST(RefinePose, WorksByTheRightCameraAlone) {
  const SyntheticObservations synthetic = MakeObservations({.noise = 0, .right = true});
  const RefinedPose refined =
      RefinePose({}, Disturbed(synthetic.T_rig_world, 0.05, 0.02), synthetic.observations, {});
  EXPECT_LT(Difference(synthetic.T_rig_world, refined.T_rig_world).norm(), 1e-6);
  EXPECT_EQ(refined.inliers, 200);
}

TEST(RefinePose, TooFewObservationsAreNotWellPosed) {
  SyntheticObservations synthetic = MakeObservations({.points = 1, .noise = 0});
  EXPECT_FALSE(RefinePose({}, synthetic.T_rig_world, synthetic.observations, {}).well_posed);
  synthetic.observations.clear();
  EXPECT_FALSE(RefinePose({}, synthetic.T_rig_world, synthetic.observations, {}).well_posed);
}

/// Normalised estimation error squared: its mean over runs is 6 if the covariance tells the truth.
double MeanErrorSquared(SyntheticOptions options, unsigned runs) {
  double nees = 0;
  for (options.seed = 1; options.seed <= runs; ++options.seed) {
    const SyntheticObservations synthetic = MakeObservations(options);
    // No gate: cutting the tails of honest noise would make the covariance too proud.
    const RefinedPose refined =
        RefinePose({}, synthetic.T_rig_world, synthetic.observations, {.rounds = 1});
    const Vector6d error = Difference(refined.T_rig_world, synthetic.T_rig_world);
    nees += error.dot(refined.covariance.ldlt().solve(error)) / runs;
  }
  return nees;
}

TEST(RefinePose, CovarianceExplainsTheErrors) {
  constexpr unsigned kRuns = 200;
  for (const bool right : {false, true}) {
    const double nees =
        MeanErrorSquared({.points = 120, .without_depth = 0.3, .right = right}, kRuns);
    // 6 +- 3 deviations of the mean (12 / runs is its variance), and what the 5 % gate costs.
    EXPECT_GT(nees, 6 - 3 * std::sqrt(12.0 / kRuns)) << right;
    EXPECT_LT(nees, 1.15 * 6 + 3 * std::sqrt(12.0 / kRuns)) << right;
  }
}

TEST(AlignPoints, FindsThePoseWithoutAFirstGuess) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const SyntheticObservations synthetic =
        MakeObservations({.noise = 0.5, .outliers = 0.5, .without_depth = 0.2, .seed = seed});
    const auto found = AlignPoints({}, synthetic.observations, {});
    ASSERT_TRUE(found) << "seed " << seed;
    EXPECT_LT(Difference(synthetic.T_rig_world, found->T_rig_world).norm(), 0.02);
  }
}

/// Certainty takes more draws than an integer counts: as many as are allowed are made.
TEST(AlignPoints, TriesEveryHypothesisWhereNothingLessIsSure) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const SyntheticObservations synthetic =
        MakeObservations({.noise = 0.5, .outliers = 0.6, .without_depth = 0.2, .seed = seed});
    const auto found = AlignPoints({}, synthetic.observations, {.confidence = 1});
    ASSERT_TRUE(found) << "seed " << seed;
    EXPECT_LT(Difference(synthetic.T_rig_world, found->T_rig_world).norm(), 0.02);
  }
}

TEST(AlignPoints, FindsNothingInNonsense) {
  SyntheticObservations synthetic = MakeObservations({.outliers = 1});
  std::mt19937 random(4);
  std::shuffle(synthetic.observations.begin(), synthetic.observations.end(), random);
  for (std::size_t i = 0; i < synthetic.observations.size(); ++i) {
    synthetic.observations[i].point =
        synthetic.observations[(i * 7 + 3) % synthetic.observations.size()].point;
  }
  EXPECT_FALSE(AlignPoints({}, synthetic.observations, {}));
  EXPECT_FALSE(AlignPoints({}, {}, {}));
}

TEST(AlignPoints, GivesTheSameBitsAgain) {
  const SyntheticObservations synthetic = MakeObservations({.outliers = 0.5});
  const auto a = AlignPoints({}, synthetic.observations, {}),
             b = AlignPoints({}, synthetic.observations, {});
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->T_rig_world.matrix(), b->T_rig_world.matrix());
}

/// Without a single observation the prior is all that is known.
TEST(RefinePose, StaysAtThePriorWhereNothingIsSeen) {
  RefinePoseOptions options;
  options.prior =
      PosePrior{Disturbed(Eigen::Isometry3d::Identity(), 0.3, 0.2), 1e4 * Matrix6d::Identity()};
  const RefinedPose pose = RefinePose({}, Eigen::Isometry3d::Identity(), {}, options);
  EXPECT_LT(Difference(options.prior->T_rig_world, pose.T_rig_world).norm(), 1e-6);
  EXPECT_TRUE(pose.well_posed);
  EXPECT_LT((pose.covariance - 1e-4 * Matrix6d::Identity()).norm(), 1e-8);
}

/// Two independent sources, each as exact as it says: so is what comes of both (NEES).
TEST(RefinePose, CovarianceWithAPriorExplainsTheErrors) {
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  double nees = 0;
  constexpr int kDraws = 300;
  for (unsigned n = 0; n < kDraws; ++n) {
    const SyntheticObservations truth = MakeObservations({.points = 12, .seed = n + 1});
    Vector6d error;
    for (int k = 0; k < 6; ++k) error[k] = (k < 3 ? 0.02 : 0.004) * normal(random);
    Vector6d variances;
    variances << Eigen::Vector3d::Constant(0.02 * 0.02), Eigen::Vector3d::Constant(0.004 * 0.004);
    RefinePoseOptions options;
    options.prior =
        PosePrior{Retract(truth.T_rig_world, error), Matrix6d(variances.asDiagonal()).inverse()};
    const RefinedPose pose =
        RefinePose({}, options.prior->T_rig_world, truth.observations, options);
    const Vector6d off = Difference(truth.T_rig_world, pose.T_rig_world);
    nees += off.dot(pose.covariance.ldlt().solve(off)) / kDraws;
  }
  // Six degrees of freedom; gates at 95 % cut tails off and let a few good ones go.
  EXPECT_GT(nees, 5);
  EXPECT_LT(nees, 8);
}

}  // namespace
}  // namespace aisle::slam
