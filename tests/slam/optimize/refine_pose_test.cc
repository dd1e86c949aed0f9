#include "slam/optimize/refine_pose.h"

#include <gtest/gtest.h>

#include <random>

#include "slam/optimize/align_points.h"
#include "slam/optimize/bundle.h"

namespace aisle::slam {
namespace {

/// Points in front of a rig at a known pose, with their measurements.
struct SyntheticSights {
  Eigen::Isometry3d T_rig_world;
  std::vector<PointSight> sights;
};

struct SyntheticOptions {
  int points = 200;
  double noise = 1;          // in deviations of each measurement
  double outliers = 0;       // share of measurements moved far away
  double without_depth = 0;  // share
  unsigned seed = 1;
};

SyntheticSights MakeSights(const SyntheticOptions& options) {
  std::mt19937 random(options.seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> normal;
  const StereoCamera camera;
  Vector6d motion;
  for (double& value : motion) value = normal(random);
  SyntheticSights synthetic;
  synthetic.T_rig_world = Retract(Eigen::Isometry3d::Identity(), motion);
  for (int i = 0; i < options.points; ++i) {
    const double z = 1 + 14 * uniform(random);
    const Eigen::Vector3d uvd(752 * uniform(random), 480 * uniform(random),
                              camera.fx * camera.baseline_m / z);
    PointSight sight;
    sight.point = synthetic.T_rig_world.inverse() * Backproject(camera, uvd);
    sight.measurement.sigma_px = 0.5 + uniform(random);
    sight.measurement.sigma_d = 0.2 + 0.3 * uniform(random);
    const Eigen::Vector3d sigma(sight.measurement.sigma_px, sight.measurement.sigma_px,
                                sight.measurement.sigma_d);
    sight.measurement.uvd = uvd;
    for (int k = 0; k < 3; ++k) {
      sight.measurement.uvd[k] += options.noise * sigma[k] * normal(random);
    }
    if (uniform(random) < options.outliers) sight.measurement.uvd.x() += 30 + 60 * uniform(random);
    if (uniform(random) < options.without_depth) sight.measurement.sigma_d = 0;
    synthetic.sights.push_back(sight);
  }
  return synthetic;
}

Eigen::Isometry3d Disturbed(const Eigen::Isometry3d& pose, double translation_m, double turn_rad) {
  Vector6d motion;
  motion << Eigen::Vector3d::Constant(translation_m), Eigen::Vector3d(1, -1, 0.5) * turn_rad;
  return Retract(pose, motion);
}

TEST(RefinePose, EqualColumnsCountTheErrorOfEitherEye) {
  const StereoCamera camera;
  const Eigen::Vector3d point(0.4, -0.2, 6);
  Measurement measurement{Project(camera, point), 2, 2, 1};
  measurement.uvd += Eigen::Vector3d(3, 1, 0.5);  // right column: 3 - 0.5 off
  const double chi2 = Chi2(camera, Eigen::Isometry3d::Identity(), {point, measurement});
  EXPECT_NEAR(chi2, (3.0 * 3 + 1 * 1 + 2.5 * 2.5) / 4, 1e-9);

  BundleProblem problem;
  problem.poses.resize(1);
  problem.points = {point};
  EXPECT_NEAR(Chi2(problem, MakeSight(0, 0, measurement)), chi2, 1e-9);
}

TEST(RefinePose, EqualColumnsFindTheLeastSquaresPose) {
  SyntheticSights synthetic = MakeSights({.noise = 1});
  for (PointSight& sight : synthetic.sights) {
    sight.measurement.sigma_d = sight.measurement.sigma_px;
    sight.measurement.u_in_d = 1;
  }
  const RefinedPose refined = RefinePose({}, synthetic.T_rig_world, synthetic.sights, {});
  const auto cost = [&](const Eigen::Isometry3d& pose) {
    double sum = 0;
    for (std::size_t i = 0; i < synthetic.sights.size(); ++i) {
      if (refined.inlier[i]) sum += Chi2({}, pose, synthetic.sights[i]);
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
  const SyntheticSights synthetic = MakeSights({.noise = 0});
  const Eigen::Isometry3d start = Disturbed(synthetic.T_rig_world, 0.3, 0.1);
  const auto error = [&](const RefinePoseOptions& options) {
    const RefinedPose refined = RefinePose({}, start, synthetic.sights, options);
    return Difference(synthetic.T_rig_world, refined.T_rig_world).norm();
  };
  // One step a round: four of them get further than the last one alone.
  EXPECT_LT(error({.iterations = 1}), 0.1 * error({.iterations = 1, .start_anew = true}));
  EXPECT_LT(error({.start_anew = true}), 1e-6);
}

TEST(RefinePose, RecoversTheTruthFromExactSights) {
  const SyntheticSights synthetic = MakeSights({.noise = 0});
  const RefinedPose refined =
      RefinePose({}, Disturbed(synthetic.T_rig_world, 0.1, 0.03), synthetic.sights, {});
  EXPECT_LT(Difference(synthetic.T_rig_world, refined.T_rig_world).norm(), 1e-7);
  EXPECT_EQ(refined.inliers, 200);
  EXPECT_TRUE(refined.well_posed);
}

TEST(RefinePose, TellsOutliersFromInliers) {
  const SyntheticSights synthetic =
      MakeSights({.noise = 0.5, .outliers = 0.4, .without_depth = 0.3});
  const RefinedPose refined =
      RefinePose({}, Disturbed(synthetic.T_rig_world, 0.03, 0.01), synthetic.sights, {});
  EXPECT_LT(Difference(synthetic.T_rig_world, refined.T_rig_world).norm(), 0.01);
  EXPECT_GT(refined.inliers, 100);
  EXPECT_LT(refined.inliers, 140);
}

TEST(RefinePose, WorksWithoutAnyDepth) {
  const SyntheticSights synthetic = MakeSights({.noise = 0, .without_depth = 1});
  const RefinedPose refined =
      RefinePose({}, Disturbed(synthetic.T_rig_world, 0.05, 0.02), synthetic.sights, {});
  EXPECT_LT(Difference(synthetic.T_rig_world, refined.T_rig_world).norm(), 1e-6);
}

TEST(RefinePose, TooFewSightsAreNotWellPosed) {
  SyntheticSights synthetic = MakeSights({.points = 1, .noise = 0});
  EXPECT_FALSE(RefinePose({}, synthetic.T_rig_world, synthetic.sights, {}).well_posed);
  synthetic.sights.clear();
  EXPECT_FALSE(RefinePose({}, synthetic.T_rig_world, synthetic.sights, {}).well_posed);
}

/// Normalised estimation error squared: its mean over runs is 6 if the covariance tells the truth.
TEST(RefinePose, CovarianceExplainsTheErrors) {
  constexpr int kRuns = 200;
  double nees = 0;
  for (unsigned seed = 1; seed <= kRuns; ++seed) {
    const SyntheticSights synthetic =
        MakeSights({.points = 120, .without_depth = 0.3, .seed = seed});
    // No gate: cutting the tails of honest noise would make the covariance too proud.
    const RefinedPose refined =
        RefinePose({}, synthetic.T_rig_world, synthetic.sights, {.rounds = 1});
    const Vector6d error = Difference(refined.T_rig_world, synthetic.T_rig_world);
    nees += error.dot(refined.covariance.ldlt().solve(error)) / kRuns;
  }
  // 6 +- 3 deviations of the mean (12 / runs is its variance), and what the 5 % gate costs.
  EXPECT_GT(nees, 6 - 3 * std::sqrt(12.0 / kRuns));
  EXPECT_LT(nees, 1.15 * 6 + 3 * std::sqrt(12.0 / kRuns));
}

TEST(AlignPoints, FindsThePoseWithoutAFirstGuess) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const SyntheticSights synthetic =
        MakeSights({.noise = 0.5, .outliers = 0.5, .without_depth = 0.2, .seed = seed});
    const auto found = AlignPoints({}, synthetic.sights, {});
    ASSERT_TRUE(found) << "seed " << seed;
    EXPECT_LT(Difference(synthetic.T_rig_world, found->T_rig_world).norm(), 0.02);
  }
}

/// Certainty takes more draws than an integer counts: as many as are allowed are made.
TEST(AlignPoints, TriesEveryHypothesisWhereNothingLessIsSure) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const SyntheticSights synthetic =
        MakeSights({.noise = 0.5, .outliers = 0.6, .without_depth = 0.2, .seed = seed});
    const auto found = AlignPoints({}, synthetic.sights, {.confidence = 1});
    ASSERT_TRUE(found) << "seed " << seed;
    EXPECT_LT(Difference(synthetic.T_rig_world, found->T_rig_world).norm(), 0.02);
  }
}

TEST(AlignPoints, FindsNothingInNonsense) {
  SyntheticSights synthetic = MakeSights({.outliers = 1});
  std::mt19937 random(4);
  std::shuffle(synthetic.sights.begin(), synthetic.sights.end(), random);
  for (std::size_t i = 0; i < synthetic.sights.size(); ++i) {
    synthetic.sights[i].point = synthetic.sights[(i * 7 + 3) % synthetic.sights.size()].point;
  }
  EXPECT_FALSE(AlignPoints({}, synthetic.sights, {}));
  EXPECT_FALSE(AlignPoints({}, {}, {}));
}

TEST(AlignPoints, GivesTheSameBitsAgain) {
  const SyntheticSights synthetic = MakeSights({.outliers = 0.5});
  const auto a = AlignPoints({}, synthetic.sights, {}), b = AlignPoints({}, synthetic.sights, {});
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->T_rig_world.matrix(), b->T_rig_world.matrix());
}

}  // namespace
}  // namespace aisle::slam
