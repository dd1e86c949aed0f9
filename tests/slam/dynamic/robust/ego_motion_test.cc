#include "slam/dynamic/robust/ego_motion.h"

#include <gtest/gtest.h>

#include "slam/dynamic/common/counter_random.h"

namespace aisle::slam::dynamic {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

const StereoCamera kCamera;
const MeasurementNoise kNoise(0.15, 0.15, 0.2);

Isometry3d Motion(const Vector3d& translation, double yaw_rad) {
  Isometry3d T = Isometry3d::Identity();
  T.translate(translation);
  T.rotate(Eigen::AngleAxisd(yaw_rad, Vector3d::UnitY()));
  return T;
}

/// Normal enough: the sum of four uniform numbers, unit deviation.
double Unit(CounterRandom& random) {
  double sum = 0;
  for (int k = 0; k < 4; ++k) sum += random.Below(1 << 20) / double{1 << 20};
  return (sum - 2) * std::sqrt(3.0);
}

Vector3d Noise(CounterRandom& random) {
  return {kNoise[0] * Unit(random), kNoise[1] * Unit(random), kNoise[2] * Unit(random)};
}

/// Points of a room seen before and after a motion; the first `movers` are one object near the
/// camera that moves by `own` as well.
std::vector<StereoMatch> MakeMatches(int count, int movers, const Isometry3d& T_now_before,
                                     const Vector3d& own, std::uint64_t seed = 1) {
  CounterRandom random(seed, 0);
  const auto uniform = [&] { return random.Below(1 << 20) / double{1 << 20} - 0.5; };
  std::vector<StereoMatch> matches;
  for (int k = 0; k < count; ++k) {
    const bool moves = k < movers;
    const Vector3d p = moves ? Vector3d(1.2 * uniform(), 2 * uniform(), 2.5 + 0.3 * uniform())
                             : Vector3d(6 * uniform(), 3 * uniform(), 5 + 6 * uniform());
    const Vector3d q = T_now_before * (moves ? Vector3d(p + own) : p);
    matches.push_back(
        {Project(kCamera, p) + Noise(random), Project(kCamera, q) + Noise(random), 1});
  }
  return matches;
}

TEST(EstimateEgoMotion, FindsTheMotionAmongMovers) {
  const Isometry3d truth = Motion({0.002, 0, -0.04}, 0.01);
  const auto matches = MakeMatches(300, 90, truth, {0.06, 0, 0});
  const EgoMotion found = EstimateEgoMotion(matches, kCamera, std::nullopt, kNoise, {});
  ASSERT_TRUE(found.found);
  EXPECT_FALSE(found.standing);
  EXPECT_LT((found.T_now_before.translation() - truth.translation()).norm(), 0.003);
  EXPECT_LT(Difference(truth, found.T_now_before).tail<3>().norm(), 0.001);
}

TEST(EstimateEgoMotion, ItsErrorIsWhatItsCovarianceSays) {
  const Isometry3d truth = Motion({0, 0, -0.05}, 0.005);
  double sum = 0;
  const int runs = 60;
  for (int run = 0; run < runs; ++run) {
    const auto matches = MakeMatches(150, 0, truth, {0, 0, 0}, static_cast<std::uint64_t>(run));
    const EgoMotion found = EstimateEgoMotion(matches, kCamera, std::nullopt, kNoise, {});
    const Vector6d error = Difference(truth, found.T_now_before);
    sum += error.dot(found.covariance.inverse() * error) / 6;
  }
  EXPECT_GT(sum / runs, 0.4);
  EXPECT_LT(sum / runs, 2.0);
}

TEST(EstimateEgoMotion, StandingStillIsExactlyIdentity) {
  const auto matches = MakeMatches(300, 60, Isometry3d::Identity(), {0.05, 0, 0});
  const EgoMotion found = EstimateEgoMotion(matches, kCamera, std::nullopt, kNoise, {});
  EXPECT_TRUE(found.standing);
  EXPECT_TRUE(found.T_now_before.isApprox(Isometry3d::Identity(), 0));
}

TEST(EstimateEgoMotion, AMajorityThatMovesAsNoVehicleCouldIsNotTheWorld) {
  const Isometry3d truth = Motion({0, 0, -0.04}, 0);
  const auto matches = MakeMatches(300, 180, truth, {0.08, 0, 0});
  const MotionPrior prior{truth, 1e-4 * Matrix6d::Identity()};
  const EgoMotion found = EstimateEgoMotion(matches, kCamera, prior, kNoise, {});
  ASSERT_TRUE(found.found);
  EXPECT_LT((found.T_now_before.translation() - truth.translation()).norm(), 0.005);
}

/// Nine tenths of all that is trusted, at the rig's own speed: it looks as if the rig had stopped.
TEST(EstimateEgoMotion, ARigInMotionIsNotStoppedByWhoGoesAlong) {
  const Isometry3d truth = Motion({0, 0, -0.045}, 0);
  const auto matches = MakeMatches(300, 270, truth, {0, 0, 0.045});
  const EgoMotion captured = EstimateEgoMotion(matches, kCamera, std::nullopt, kNoise, {});
  EXPECT_LT(captured.T_now_before.translation().norm(), 0.01);

  const MotionPrior prior{Motion({0, 0, -0.043}, 0.002), 2e-5 * Matrix6d::Identity()};
  const EgoMotion found = EstimateEgoMotion(matches, kCamera, prior, kNoise, {});
  ASSERT_TRUE(found.found);
  EXPECT_LT((found.T_now_before.translation() - truth.translation()).norm(), 0.005);
}

/// Who goes along at the rig's speed does not move in the image, and a sample of three points has
/// no noise there; a sample of the world, which fills more of space, has the noise of all three.
TEST(EstimateEgoMotion, AWorldOfLittleMoreIsNotLostToTheNoiseOfItsSamples) {
  const Isometry3d truth = Motion({0, 0, -0.12}, 0);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    auto matches = MakeMatches(300, 150, truth, {0, 0, 0.12}, seed);
    for (std::size_t k = 150; k < matches.size(); ++k) matches[k].weight = 0.1;
    const EgoMotion found = EstimateEgoMotion(matches, kCamera, std::nullopt, kNoise, {});
    ASSERT_TRUE(found.found);
    EXPECT_LT((found.T_now_before.translation() - truth.translation()).norm(), 0.01) << seed;
  }
}

/// Three far points follow the motion, too few and too far to tell that it was not zero.
TEST(EstimateEgoMotion, ThreeFarPointsDoNotStopARigThatIsExpectedToGo) {
  const Isometry3d truth = Motion({0, 0, -0.045}, 0);
  auto matches = MakeMatches(300, 297, truth, {0, 0, 0.045});
  for (std::size_t k = 0; k < 297; ++k) matches[k].weight = 0.01;
  const MotionPrior prior{Motion({0, 0, -0.043}, 0), 2e-5 * Matrix6d::Identity()};
  const EgoMotion found = EstimateEgoMotion(matches, kCamera, prior, kNoise, {});
  ASSERT_TRUE(found.found);
  EXPECT_FALSE(found.standing);
  EXPECT_LT((found.T_now_before.translation() - truth.translation()).norm(), 0.005);
}

/// A person half a metre ahead who moves by `own`, and `far` points of the hall that he leaves free
/// at his right.
std::vector<StereoMatch> BehindSomebody(int far, const Isometry3d& T_now_before,
                                        const Vector3d& own, std::uint64_t seed) {
  CounterRandom random(seed, 0);
  const auto uniform = [&] { return random.Below(1 << 20) / double{1 << 20} - 0.5; };
  std::vector<StereoMatch> matches;
  for (int k = 0; k < 120 + far; ++k) {
    const double depth = k < 120 ? 0.5 + 0.1 * uniform() : 8 + 6 * uniform();
    const Vector3d p = k < 120
                           ? Vector3d(0.5 * uniform(), 0.4 * uniform(), depth)
                           : Vector3d(depth * (0.7 + 0.1 * uniform()), depth * uniform(), depth);
    const Vector3d q = T_now_before * (k < 120 ? Vector3d(p + own) : p);
    matches.push_back(
        {Project(kCamera, p) + Noise(random), Project(kCamera, q) + Noise(random), 1});
  }
  return matches;
}

/// The hall tells how the rig has turned, and too little of how it has moved: he tells that, as he
/// is near.
TEST(EstimateEgoMotion, WhoSwaysCloseAheadDoesNotPullARigThatStands) {
  const MotionPrior prior{Isometry3d::Identity(), 1.5e-5 * Matrix6d::Identity()};
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto matches = BehindSomebody(40, Isometry3d::Identity(), {0.0012, 0, 0}, seed);
    const EgoMotion found = EstimateEgoMotion(matches, kCamera, prior, kNoise, {});
    EXPECT_TRUE(found.standing) << seed << "\n" << found.T_now_before.translation();
  }
}

/// He is around the camera's axis, in one cubic metre of space.
TEST(EstimateEgoMotion, WhoFillsTheViewHasOneVote) {
  const Isometry3d truth = Motion({0, 0, -0.1}, 0);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto matches = BehindSomebody(4, truth, {0, 0, 0.1}, seed);
    const EgoMotion found = EstimateEgoMotion(matches, kCamera, std::nullopt, kNoise, {});
    ASSERT_TRUE(found.found);
    EXPECT_LT((found.T_now_before.translation() - truth.translation()).norm(), 0.06) << seed;
  }
}

TEST(EstimateEgoMotion, GoesOnAsExpectedWhereNothingSeenIsPossible) {
  const auto matches = MakeMatches(300, 300, Isometry3d::Identity(), {0.5, 0, 0});
  const MotionPrior prior{Motion({0, 0, -0.045}, 0), 1e-6 * Matrix6d::Identity()};
  const EgoMotion found = EstimateEgoMotion(matches, kCamera, prior, kNoise, {});
  ASSERT_TRUE(found.found);
  EXPECT_EQ(found.T_now_before.matrix(), prior.T_now_before.matrix());
  EXPECT_TRUE(found.covariance.isApprox(prior.covariance));
}

TEST(EstimateEgoMotion, WhatNoVehicleCanDoHardlyMovesWhatIsExpected) {
  const auto matches = MakeMatches(300, 300, Isometry3d::Identity(), {0, 0, 0});
  const MotionPrior prior{Motion({0, 0, -0.045}, 0), 1e-6 * Matrix6d::Identity()};
  EXPECT_FALSE(IsPossible(Isometry3d::Identity(), prior));
  const EgoMotion found = EstimateEgoMotion(matches, kCamera, prior, kNoise, {});
  ASSERT_TRUE(found.found);
  EXPECT_TRUE(IsPossible(found.T_now_before, prior));
  EXPECT_LT((found.T_now_before.translation() - prior.T_now_before.translation()).norm(), 0.001);
}

/// The rig goes ahead at 1 m/s, as it has; inertia expects that, and allows for a jolt or not.
MotionPrior GoesAhead(bool jolts) {
  MotionPrior prior{Motion({0, 0, -0.05}, 0)};
  Vector6d deviation;
  deviation << Vector3d::Constant(0.004), Vector3d::Constant(0.008);
  prior.covariance = deviation.cwiseAbs2().asDiagonal();
  if (!jolts) return prior;
  Vector6d jolt;
  jolt << 0, 0.025, 0, 0.05, 0, 0.05;
  prior.jolt = jolt.cwiseAbs2().asDiagonal();
  return prior;
}

TEST(EstimateEgoMotion, AJoltOfAllThatIsSeenIsTheRigs) {
  Isometry3d truth = Motion({0, 0.01, -0.05}, 0);
  truth.rotate(Eigen::AngleAxisd(0.06, Vector3d::UnitX()));
  const auto matches = MakeMatches(300, 60, truth, {0.06, 0, 0});
  const EgoMotion without = EstimateEgoMotion(matches, kCamera, GoesAhead(false), kNoise, {});
  EXPECT_GT(Difference(truth, without.T_now_before).tail<3>().norm(), 0.03);
  const EgoMotion found = EstimateEgoMotion(matches, kCamera, GoesAhead(true), kNoise, {});
  ASSERT_TRUE(found.found);
  EXPECT_GT(found.support, 100);
  EXPECT_LT((found.T_now_before.translation() - truth.translation()).norm(), 0.003);
  EXPECT_LT(Difference(truth, found.T_now_before).tail<3>().norm(), 0.001);
}

TEST(EstimateEgoMotion, WithoutAnyTrustTheRigGoesOnAsExpected) {
  auto matches = MakeMatches(300, 0, Motion({0, 0.01, -0.05}, 0), {0, 0, 0});
  for (StereoMatch& match : matches) match.weight = 0;
  for (const bool jolts : {false, true}) {
    const EgoMotion found = EstimateEgoMotion(matches, kCamera, GoesAhead(jolts), kNoise, {});
    EXPECT_TRUE(found.found);
    EXPECT_TRUE(found.T_now_before.isApprox(GoesAhead(jolts).T_now_before, 0));
    EXPECT_TRUE(found.covariance.isApprox(GoesAhead(jolts).covariance));
  }
  EXPECT_FALSE(EstimateEgoMotion(matches, kCamera, std::nullopt, kNoise, {}).found);
}

/// No three of them make a triangle, so that there is no sample of a motion.
TEST(EstimateEgoMotion, WhatIsAllInOnePlaceAndGoesOffIsNoJolt) {
  const Vector3d before(0.3, 0.2, 3), now = before + Vector3d(0.5, 0, 0);
  const std::vector<StereoMatch> matches(50, {Project(kCamera, before), Project(kCamera, now)});
  const EgoMotion found = EstimateEgoMotion(matches, kCamera, GoesAhead(true), kNoise, {});
  EXPECT_TRUE(found.found);
  EXPECT_TRUE(found.T_now_before.isApprox(GoesAhead(true).T_now_before, 0));
}

TEST(EstimateEgoMotion, WhoWalksBeforeMostOfTheViewIsNoJolt) {
  const Isometry3d truth = Motion({0, 0, -0.05}, 0);
  const auto matches = MakeMatches(300, 240, truth, {0.07, 0, 0.02});
  const EgoMotion found = EstimateEgoMotion(matches, kCamera, GoesAhead(true), kNoise, {});
  ASSERT_TRUE(found.found);
  EXPECT_LT((found.T_now_before.translation() - truth.translation()).norm(), 0.004);
}

TEST(EstimateEgoMotion, DistrustedPointsDoNotVote) {
  const Isometry3d truth = Motion({0, 0, -0.04}, 0);
  auto matches = MakeMatches(300, 200, truth, {0.08, 0, 0});
  for (std::size_t k = 0; k < 200; ++k) matches[k].weight = 0.02;
  const EgoMotion found = EstimateEgoMotion(matches, kCamera, std::nullopt, kNoise, {});
  EXPECT_LT((found.T_now_before.translation() - truth.translation()).norm(), 0.005);
}

TEST(EstimateEgoMotion, TooFewPointsAreNoMotion) {
  const auto matches = MakeMatches(4, 0, Isometry3d::Identity(), {0, 0, 0});
  EXPECT_FALSE(EstimateEgoMotion(matches, kCamera, std::nullopt, kNoise, {}).found);
  EXPECT_FALSE(EstimateEgoMotion({}, kCamera, std::nullopt, kNoise, {}).found);
}

TEST(MatchChi2, OfStaticPointsIsChiSquareAndOfMoversLarge) {
  const Isometry3d T = Motion({0.002, 0, -0.04}, 0.005);
  const auto matches = MakeMatches(2000, 200, T, {0.1, 0, 0});
  double sum = 0;
  int missed = 0;
  for (std::size_t k = 0; k < matches.size(); ++k) {
    const double chi2 = MatchChi2(kCamera, T, matches[k], kNoise);
    if (k < 200) {
      missed += chi2 < 11.34 ? 1 : 0;
    } else {
      sum += chi2;
    }
  }
  EXPECT_NEAR(sum / 1800, 3, 0.3);  // the mean of three degrees of freedom
  EXPECT_EQ(missed, 0);
}

TEST(MatchChi2, SeesMotionAlongTheEpipolarLine) {
  // Walking away before a camera that stands: the flow points at the epipole, disparity tells.
  const Vector3d before(0.05, 0.02, 3), now = before + Vector3d(0, 0, 0.3);
  const StereoMatch match{Project(kCamera, before), Project(kCamera, now), 1};
  EXPECT_GT(MatchChi2(kCamera, Isometry3d::Identity(), match, kNoise), 11.34);
}

TEST(MeasureNoise, FindsTheNoiseThatWasAdded) {
  const Isometry3d T = Motion({0, 0, -0.05}, 0);
  auto matches = MakeMatches(1500, 0, T, {0, 0, 0});
  const auto noise = MeasureNoise(matches, kCamera, T);
  ASSERT_TRUE(noise);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR((*noise)[k], kNoise[k], 0.1 * kNoise[k]);
  matches.resize(10);
  EXPECT_FALSE(MeasureNoise(matches, kCamera, T));
}

TEST(MeasureNoise, IsNotThatOfACrowdInOnePlace) {
  const Isometry3d T = Motion({0, 0, -0.05}, 0);
  auto matches = MakeMatches(600, 0, T, {0, 0, 0});
  const auto quiet = MeasureNoise(matches, kCamera, T);
  for (int k = 0; k < 900; ++k) {  // all within one cubic metre, all their own way
    const Vector3d point(0.3 + 0.001 * k / 3, 0.2, 1.5), way(0, 0.002 * (k % 50), 0);
    matches.push_back({Project(kCamera, point), Project(kCamera, T * point + way), 1});
  }
  const auto beside = MeasureNoise(matches, kCamera, T);
  ASSERT_TRUE(quiet && beside);
  EXPECT_LT((*beside)[1], 1.5 * (*quiet)[1]);
}

/// Somebody walks ahead as fast as the rig drives and fills nine tenths of what is matched: a
/// standing rig explains him. What the wheels say does not let it.
TEST(EstimateEgoMotion, AMeasuredMotionIsNotOutvotedByWhoGoesAlong) {
  const Isometry3d truth = Motion({0, 0, -0.05}, 0);
  const auto matches = MakeMatches(300, 270, truth, {0, 0, 0.05});
  const EgoMotion captured = EstimateEgoMotion(matches, kCamera, std::nullopt, kNoise, {});
  EXPECT_LT(captured.T_now_before.translation().norm(), 0.005);
  const MotionPrior prior{Motion({0, 0, -0.0505}, 0), 4e-6 * Matrix6d::Identity(), true};
  const EgoMotion found = EstimateEgoMotion(matches, kCamera, prior, kNoise, {});
  ASSERT_TRUE(found.found);
  EXPECT_FALSE(found.standing);
  EXPECT_LT((found.T_now_before.translation() - truth.translation()).norm(), 0.002);
}

TEST(EstimateEgoMotion, WithoutMatchesTheMeasuredMotionStands) {
  const MotionPrior prior{Motion({0.01, 0, -0.05}, 0.02), 1e-6 * Matrix6d::Identity(), true};
  const EgoMotion found = EstimateEgoMotion({}, kCamera, prior, kNoise, {});
  EXPECT_TRUE(found.found);
  EXPECT_TRUE(found.T_now_before.isApprox(prior.T_now_before, 0));
  EXPECT_TRUE(found.covariance.isApprox(1e-6 * Matrix6d::Identity(), 1e-9));
}

}  // namespace
}  // namespace aisle::slam::dynamic
