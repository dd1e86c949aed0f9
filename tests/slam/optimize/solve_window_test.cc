#include "slam/optimize/solve_window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "slam/camera/se3.h"
#include "slam/optimize/normal_equations.h"
#include "slam/optimize/solve_sparse.h"

namespace aisle::slam {
namespace {

Vector6d Noise(std::mt19937_64& bits, double metres, double radians) {
  std::normal_distribution<double> normal;
  Vector6d noise;
  for (int i = 0; i < 6; ++i) noise[i] = normal(bits) * (i < 3 ? metres : radians);
  return noise;
}

/// A drive past scattered points: noisy pixels, every third point without disparity, every
/// nineteenth observation wrong by 30 pixels; the first two poses fixed, all disturbed.
BundleProblem Drive(unsigned seed, int poses = 9, int points = 150) {
  std::mt19937_64 bits(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::normal_distribution<double> normal;
  BundleProblem problem;
  std::vector<Eigen::Isometry3d> truth;
  for (int p = 0; p < poses; ++p) {
    Vector6d motion;
    motion << 0.05 * p, 0, -0.2 * p, 0, 0.02 * p, 0;
    truth.push_back(Retract(Eigen::Isometry3d::Identity(), motion));
    const bool fixed = p < 2;
    problem.poses.push_back(
        {fixed ? truth.back() : Retract(truth.back(), Noise(bits, 0.02, 0.004)), fixed});
  }
  for (int i = 0; i < points; ++i) {
    const Eigen::Vector3d point(4 * uniform(bits), 2 * uniform(bits), 7 + 3 * uniform(bits));
    for (int p = 0; p < poses; ++p) {
      if ((i + 2 * p) % 5 == 0) continue;
      Measurement measurement;
      measurement.uvd = Project(problem.camera, truth[static_cast<std::size_t>(p)] * point);
      for (int k = 0; k < 3; ++k) measurement.uvd[k] += 0.4 * normal(bits);
      measurement.sigma_d = i % 3 ? 0.5 : 0;
      if ((i * poses + p) % 19 == 0) measurement.uvd.x() += 30;
      problem.observations.push_back(MakeObservation(p, i, measurement));
    }
    problem.points.push_back(point + Noise(bits, 0.05, 0).head<3>());
  }
  return problem;
}

double Apart(const BundleProblem& a, const BundleProblem& b) {
  double apart = 0;
  for (std::size_t p = 0; p < a.poses.size(); ++p) {
    apart = std::max(apart, Difference(a.poses[p].T_rig_world, b.poses[p].T_rig_world).norm());
  }
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    apart = std::max(apart, (a.points[i] - b.points[i]).norm());
  }
  return apart;
}

BundleProblem Displaced(BundleProblem problem, const BundleOrder& order, std::size_t variable,
                        double by) {
  const std::size_t of_poses = 6 * order.free_poses.size();
  if (variable < of_poses) {
    Eigen::Isometry3d& pose = problem.poses[order.free_poses[variable / 6]].T_rig_world;
    pose = Retract(pose, by * Vector6d::Unit(static_cast<Eigen::Index>(variable % 6)));
  } else {
    const std::size_t i = variable - of_poses;
    problem.points[order.points[i / 3].point][static_cast<Eigen::Index>(i % 3)] += by;
  }
  return problem;
}

TEST(NormalEquations, GradientAgreesWithDifferencesOfTheCost) {
  const BundleProblem problem = Drive(3, 4, 12);
  const BundleOrder order = OrderOf(problem, {});
  for (const bool robust : {false, true}) {
    const NormalEquations equations = Linearize(problem, order, robust);
    std::vector<double> gradient;
    for (const Vector6d& g : equations.pose_g) gradient.insert(gradient.end(), g.begin(), g.end());
    for (const auto& point : equations.points) {
      gradient.insert(gradient.end(), point.g.begin(), point.g.end());
    }
    constexpr double kStep = 1e-6;
    for (std::size_t i = 0; i < gradient.size(); ++i) {
      const double ahead = CostOf(Displaced(problem, order, i, kStep), order, robust).value();
      const double behind = CostOf(Displaced(problem, order, i, -kStep), order, robust).value();
      EXPECT_NEAR(gradient[i], (ahead - behind) / (2 * kStep), 1e-4 * (1 + std::abs(gradient[i])))
          << "variable " << i << (robust ? ", robust" : "");
    }
  }
}

struct WholeSystem {
  Eigen::MatrixXd H;
  Eigen::VectorXd g;
};

/// The blocks put together: free poses first, then the points that are seen.
WholeSystem Whole(const NormalEquations& equations) {
  const std::size_t poses = equations.pose_H.size(), points = equations.points.size();
  const auto size = static_cast<Eigen::Index>(6 * poses + 3 * points);
  WholeSystem whole{Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd(size)};
  for (std::size_t p = 0; p < poses; ++p) {
    const auto at = static_cast<Eigen::Index>(6 * p);
    whole.H.block<6, 6>(at, at) = equations.pose_H[p];
    whole.g.segment<6>(at) = equations.pose_g[p];
  }
  for (std::size_t i = 0; i < points; ++i) {
    const auto at = static_cast<Eigen::Index>(6 * poses + 3 * i);
    whole.H.block<3, 3>(at, at) = equations.points[i].H;
    whole.g.segment<3>(at) = equations.points[i].g;
    for (std::size_t k = equations.points[i].begin; k < equations.points[i].end; ++k) {
      const auto& coupling = equations.couplings[k];
      whole.H.block<6, 3>(6 * coupling.pose, at) += coupling.H;
      whole.H.block<3, 6>(at, 6 * coupling.pose) += coupling.H.transpose();
    }
  }
  return whole;
}

/// How far two solutions lie apart in standard deviations of what was measured: metres say nothing
/// where rays are nearly parallel.
double DeviationsApart(const BundleProblem& a, const BundleProblem& b, bool robust) {
  const BundleOrder order = OrderOf(a, {});
  const Eigen::MatrixXd H = Whole(Linearize(a, order, robust)).H;
  Eigen::VectorXd apart(H.rows());
  Eigen::Index at = 0;
  for (const std::size_t p : order.free_poses) {
    apart.segment<6>(at) = Difference(a.poses[p].T_rig_world, b.poses[p].T_rig_world);
    at += 6;
  }
  for (const auto& seen : order.points) {
    apart.segment<3>(at) = b.points[seen.point] - a.points[seen.point];
    at += 3;
  }
  return std::sqrt(apart.dot(H * apart));
}

/// An undamped step solves the whole system, as a dense solver without any elimination does.
TEST(NormalEquations, EliminationSolvesTheWholeSystem) {
  const BundleProblem problem = Drive(4, 5, 20);
  const NormalEquations equations = Linearize(problem, OrderOf(problem, {}), false);
  constexpr double kDamping = 1e-3;
  const std::size_t poses = equations.pose_H.size(), points = equations.points.size();
  const auto [H, g] = Whole(equations);
  EXPECT_GT(H.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0);
  const Eigen::VectorXd raise = kDamping * H.diagonal();
  const Eigen::VectorXd whole =
      (H + Eigen::MatrixXd(raise.asDiagonal())).colPivHouseholderQr().solve(-g);
  const std::optional<SolvedStep> solved = SolveDamped(equations, kDamping);
  ASSERT_TRUE(solved);
  for (std::size_t p = 0; p < poses; ++p) {
    const auto at = static_cast<Eigen::Index>(6 * p);
    EXPECT_LT((solved->step.poses[p] - whole.segment<6>(at)).norm(), 1e-9 * whole.norm());
  }
  for (std::size_t i = 0; i < points; ++i) {
    const auto at = static_cast<Eigen::Index>(6 * poses + 3 * i);
    EXPECT_LT((solved->step.points[i] - whole.segment<3>(at)).norm(), 1e-9 * whole.norm());
  }
  const double decrease = -(g.dot(whole) + 0.5 * whole.dot(H * whole));
  EXPECT_NEAR(solved->predicted_decrease, decrease, 1e-9 * decrease);
}

/// Ceres, another implementation of another elimination, ends in the same place.
TEST(SolveWindow, EndsWhereCeresEnds) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    for (const bool robust : {false, true}) {
      BundleProblem ours = Drive(seed), theirs = ours;
      const BundleOptions exact{200, robust, 1e-14};
      const BundleSummary own = SolveWindow(ours, {}, exact);
      const BundleSummary other = SolveSparse(theirs, {}, exact);
      EXPECT_TRUE(own.usable && other.usable);
      EXPECT_NEAR(own.initial_cost, other.initial_cost, 1e-9 * other.initial_cost);
      EXPECT_NEAR(own.final_cost, other.final_cost, 1e-8 * other.final_cost) << seed << robust;
      EXPECT_LT(DeviationsApart(ours, theirs, robust), 1e-3) << seed << robust;
    }
  }
}

TEST(SolveWindow, LeavesOutWhatIsNotActive) {
  BundleProblem problem = Drive(5);
  std::vector<bool> active;
  for (const auto& observation : problem.observations) active.push_back(observation.point % 2 == 0);
  BundleProblem half = problem;
  std::erase_if(half.observations, [](const auto& one) { return one.point % 2 != 0; });
  SolveWindow(problem, active, {});
  SolveWindow(half, {}, {});
  EXPECT_EQ(Apart(problem, half), 0);
}

TEST(SolveWindow, OrderOfObservationsChangesNoBit) {
  BundleProblem a = Drive(6), b = a;
  std::shuffle(b.observations.begin(), b.observations.end(), std::mt19937_64(1));
  SolveWindow(a, {}, {});
  SolveWindow(b, {}, {});
  EXPECT_EQ(Apart(a, b), 0);
}

/// Two corners of one keyframe may be told to be one point.
TEST(SolveWindow, TakesAPointThatAPoseSeesTwice) {
  BundleProblem ours = Drive(7);
  for (std::size_t i = 0; i < 60; i += 2) {
    BundleProblem::Observation again = ours.observations[i];
    again.uvd.y() += 1;
    ours.observations.push_back(again);
  }
  BundleProblem theirs = ours;
  const double own = SolveWindow(ours, {}, {200, true, 1e-14}).final_cost;
  const double other = SolveSparse(theirs, {}, {200, true, 1e-14}).final_cost;
  EXPECT_NEAR(own, other, 1e-8 * other);
}

TEST(SolveWindow, WithoutFreePosesPlacesThePoints) {
  BundleProblem ours = Drive(8);
  for (BundleProblem::Pose& pose : ours.poses) pose.fixed = true;
  BundleProblem theirs = ours;
  const double own = SolveWindow(ours, {}, {200, true, 1e-14}).final_cost;
  const double other = SolveSparse(theirs, {}, {200, true, 1e-14}).final_cost;
  EXPECT_NEAR(own, other, 1e-8 * other);
}

TEST(SolveWindow, RefusesAStartBehindTheCameraAndTouchesNothing) {
  BundleProblem problem = Drive(9);
  problem.points[0].z() = -5;
  const BundleProblem before = problem;
  EXPECT_FALSE(SolveWindow(problem, {}, {}).usable);
  EXPECT_EQ(Apart(problem, before), 0);
}

/// A point far away and seen by nearly parallel rays is hardly held along them.
TEST(SolveWindow, NeverRaisesTheCost) {
  for (unsigned seed = 20; seed < 40; ++seed) {
    BundleProblem problem = Drive(seed);
    for (std::size_t i = 0; i < problem.points.size(); i += 7) problem.points[i] *= 40;
    const BundleSummary summary = SolveWindow(problem, {}, {});
    EXPECT_LE(summary.final_cost, summary.initial_cost);
    EXPECT_NEAR(CostOf(problem, OrderOf(problem, {}), true).value(), summary.final_cost,
                1e-9 * summary.final_cost);
  }
}

}  // namespace
}  // namespace aisle::slam
